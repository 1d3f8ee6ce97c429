// list_tables.cpp — writes, while kurbel is built, the coefficients of the implicit pairs that a run takes, as SUNDIALS has
// them and to the last bit: of its own tables, 26 kB, the run-time needs three.
#include <cstdio>  // which the headers take for granted

#include <arkode/arkode_butcher_dirk.h>

#include <initializer_list>
#include <utility>

int main() {
  for (const auto& [name, id] : {std::pair("ARKODE_ESDIRK325L2SA_5_2_3", ARKODE_ESDIRK325L2SA_5_2_3),
                                 std::pair("ARKODE_ESDIRK436L2SA_6_3_4", ARKODE_ESDIRK436L2SA_6_3_4),
                                 std::pair("ARKODE_ESDIRK547L2SA2_7_4_5", ARKODE_ESDIRK547L2SA2_7_4_5)}) {
    const ARKodeButcherTable table = ARKodeButcherTable_LoadDIRK(id);
    if (!table) return 1;
    std::printf("{\"%s\", %d, %d, %d, %d, {", name, static_cast<int>(id), table->stages, table->q, table->p);
    for (int i = 0; i < table->stages; ++i) {  // a line of the table, up to the diagonal, with what stands beside it
      for (int j = 0; j <= i; ++j) std::printf("%a, ", table->A[i][j]);
      std::printf("%a, %a, %a,\n", table->b[i], table->c[i], table->d[i]);
    }
    std::printf("}},\n");
    ARKodeButcherTable_Free(table);
  }
}
