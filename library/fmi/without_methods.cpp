// without_methods.cpp — what stands in the run-time for integrators that it does not take: multistep methods, which every
// communication point would begin anew at order 1, and the parts of ARKODE that one diagonally implicit pair leaves alone.
// Functions by their signatures in SUNDIALS' headers; its archives give what is not defined here.
#include <cstdio>  // which the headers take for granted

#include <arkode/arkode_butcher.h>
#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_mristep.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "engine/steppers/sundials_stepper.h"

namespace kurbel {

std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem&, const ErrorControl&) {
  throw std::logic_error("an exported component has no multistep methods");
}
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control) {
  return make_bdf_stepper(system, control);
}

}  // namespace kurbel

extern "C" {

// --- tables of coefficients: memory alone, for those of ARKODE need no check of their order ---

void ARKodeButcherTable_Free(ARKodeButcherTable table) {
  if (!table) return;
  if (table->A) std::free(table->A[0]);
  for (void* const part : {static_cast<void*>(table->A), static_cast<void*>(table->c)}) std::free(part);
  std::free(table);
}

// One block holds the rows of A, another c, b and, of an embedded pair, d; all zero.
ARKodeButcherTable ARKodeButcherTable_Alloc(int stages, booleantype embedded) {
  if (stages < 1) return nullptr;
  const auto s = static_cast<std::size_t>(stages);
  auto* const table = static_cast<ARKodeButcherTable>(std::calloc(1, sizeof(ARKodeButcherTableMem)));
  if (!table) return nullptr;
  table->stages = stages;
  table->A = static_cast<realtype**>(std::calloc(s, sizeof(realtype*)));
  table->c = static_cast<realtype*>(std::calloc(3 * s, sizeof(realtype)));
  auto* const rows = static_cast<realtype*>(std::calloc(s * s, sizeof(realtype)));
  if (!table->A || !table->c || !rows) {
    std::free(rows);
    std::free(table->A), table->A = nullptr;
    ARKodeButcherTable_Free(table);
    return nullptr;
  }
  for (std::size_t k = 0; k < s; ++k) table->A[k] = rows + k * s;
  table->b = table->c + s;
  table->d = embedded ? table->b + s : nullptr;
  return table;
}

ARKodeButcherTable ARKodeButcherTable_Copy(ARKodeButcherTable from) {
  ARKodeButcherTable to = from ? ARKodeButcherTable_Alloc(from->stages, from->d != nullptr) : nullptr;
  if (!to) return nullptr;
  to->q = from->q, to->p = from->p;
  const auto s = static_cast<std::size_t>(from->stages);
  for (std::size_t k = 0; k < s; ++k) std::copy_n(from->A[k], s, to->A[k]);
  std::copy_n(from->c, s, to->c);
  std::copy_n(from->b, s, to->b);
  if (from->d) std::copy_n(from->d, s, to->d);
  return to;
}

void ARKodeButcherTable_Space(ARKodeButcherTable table, sunindextype* integers, sunindextype* reals) {
  *integers = table ? 3 : 0;
  *reals = table ? table->stages * (table->stages + 3) : 0;
}
void ARKodeButcherTable_Write(ARKodeButcherTable, std::FILE*) {}

// --- explicit pairs, and steps of several rates: there are none ---

ARKodeButcherTable ARKodeButcherTable_LoadERK(ARKODE_ERKTableID) { return nullptr; }
ARKODE_ERKTableID arkButcherTableERKNameToID(const char*) { return ARKODE_ERK_NONE; }

int MRIStepInnerStepper_Create(SUNContext, MRIStepInnerStepper*) { return -1; }
int MRIStepInnerStepper_SetContent(MRIStepInnerStepper, void*) { return -1; }
int MRIStepInnerStepper_GetContent(MRIStepInnerStepper, void**) { return -1; }
int MRIStepInnerStepper_SetEvolveFn(MRIStepInnerStepper, MRIStepInnerEvolveFn) { return -1; }
int MRIStepInnerStepper_SetFullRhsFn(MRIStepInnerStepper, MRIStepInnerFullRhsFn) { return -1; }
int MRIStepInnerStepper_SetResetFn(MRIStepInnerStepper, MRIStepInnerResetFn) { return -1; }
int MRIStepInnerStepper_GetForcingData(MRIStepInnerStepper, realtype*, realtype*, N_Vector**, int*) { return -1; }

}  // extern "C"
