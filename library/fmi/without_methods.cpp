// without_methods.cpp — what stands in the run-time for integrators that it does not take: multistep methods, which every
// communication point would begin anew at order 1, the work equation over the angle, and the parts of SUNDIALS that a
// diagonally implicit pair with sparse matrices leaves alone.
// Functions by their signatures in SUNDIALS' headers; its archives give what is not defined here.
#include <cstdio>  // which the headers take for granted

#include <arkode/arkode_butcher.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_mristep.h>
#include <sundials/sundials_logger.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "engine/rigid/work_stepper.h"
#include "engine/steppers/sundials_stepper.h"

namespace kurbel {

std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem&, const ErrorControl&) {
  throw std::logic_error("an exported component has no multistep methods");
}
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control) {
  return make_bdf_stepper(system, control);
}
std::unique_ptr<Stepper> make_work_stepper(Equations&, const ErrorControl&, std::shared_ptr<WorkTables>) {
  throw std::logic_error("an exported component has no work equation");
}
std::string WorkTables::refusal(const std::shared_ptr<const Model>&) {
  return "an exported component has no work equation";
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

// --- roots, which the run looks for; dense and banded matrices; sensitivities; messages: none is requested ---

int arkRootInit(void*, int, void*) { return -1; }
int arkRootFree(void*) { return 0; }
int arkPrintRootMem(void*, std::FILE*) { return 0; }
int arkRootCheck1(void*) { return 0; }
int arkRootCheck2(void*) { return 0; }
int arkRootCheck3(void*) { return 0; }
realtype* SUNDenseMatrix_Column(SUNMatrix, sunindextype) { return nullptr; }
sunindextype SUNDenseMatrix_Columns(SUNMatrix) { return 0; }
realtype* SUNBandMatrix_Column(SUNMatrix, sunindextype) { return nullptr; }
sunindextype SUNBandMatrix_Columns(SUNMatrix) { return 0; }
sunindextype SUNBandMatrix_LowerBandwidth(SUNMatrix) { return 0; }
sunindextype SUNBandMatrix_UpperBandwidth(SUNMatrix) { return 0; }
N_Vector N_VNew_SensWrapper(int, N_Vector) { return nullptr; }
int SUNLogger_Create(void*, int, SUNLogger* logger) { return *logger = nullptr, 0; }
int SUNLogger_SetErrorFilename(SUNLogger, const char*) { return 0; }
int SUNLogger_SetWarningFilename(SUNLogger, const char*) { return 0; }
int SUNLogger_SetInfoFilename(SUNLogger, const char*) { return 0; }
int SUNLogger_SetDebugFilename(SUNLogger, const char*) { return 0; }
int SUNLogger_Destroy(SUNLogger*) { return 0; }

// --- implicit pairs: those that a run takes (list_tables.cpp) ---

namespace {
const struct {
  const char* name;
  int id, stages, q, p;
  double numbers[7 * 8 / 2 + 3 * 7];
} pairs[] = {
#include <kurbel_fmi_tables.h>
};
}  // namespace

ARKodeButcherTable ARKodeButcherTable_LoadDIRK(ARKODE_DIRKTableID id) {
  for (const auto& pair : pairs) {
    if (pair.id != id) continue;
    const ARKodeButcherTable table = ARKodeButcherTable_Alloc(pair.stages, 1);
    if (!table) return nullptr;
    table->q = pair.q, table->p = pair.p;
    const double* number = pair.numbers;
    for (int i = 0; i < pair.stages; ++i) {
      for (int j = 0; j <= i; ++j) table->A[i][j] = *number++;
      table->b[i] = *number++, table->c[i] = *number++, table->d[i] = *number++;
    }
    return table;
  }
  return nullptr;
}
ARKODE_DIRKTableID arkButcherTableDIRKNameToID(const char* name) {
  for (const auto& pair : pairs)
    if (std::strcmp(pair.name, name) == 0) return static_cast<ARKODE_DIRKTableID>(pair.id);
  return ARKODE_DIRK_NONE;
}

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
