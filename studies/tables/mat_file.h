// mat_file.h — a table in the layout of Modelica results ("binTrans"), as a MAT file of version 5.
//
//   Aclass       char 4 × n    "Atrajectory", "1.1", a remark, "binTrans": all following matrices are transposed
//   name         char n × N    one column per quantity
//   description  char n × N    its words and its unit: "torque [N.m]"
//   dataInfo     int32 4 × N   matrix (0: the abscissa, 1, 2); row in it, from 1; 0: linear between its columns;
//                              −1: unknown beyond the ends, 0: constant there
//   data_1       double        constants: the abscissa's ends, then one row per constant, at both ends
//   data_2       double        the abscissa, then one row per quantity; one column per row of the table
//
// The layout is that of Dymola's manual and of Modelica tools (DyMat, buildingspy), whose MAT reader accepts it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/data/data_table.h"

namespace kurbel {

struct MatConstant {
  std::string name, unit, words;
  double value = 0;
};

// The file's bytes; empty: the 2 GB limit of a version 5 matrix is exceeded. Columns of words, and constants with the
// name of a column, are omitted.
std::optional<std::string> mat_file(const DataTable& table, const std::vector<MatConstant>& constants);

}  // namespace kurbel
