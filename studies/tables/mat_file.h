// mat_file.h — a table in the layout of Modelica's results ("binTrans"), as a MAT file of version 5.
//
//   Aclass       char 4 × n    "Atrajectory", "1.1", a remark, "binTrans": everything below is transposed
//   name         char n × N    a column a quantity
//   description  char n × N    its words and its unit: "torque [N.m]"
//   dataInfo     int32 4 × N   matrix (0: the abscissa, 1, 2); row in it, from 1; 0: linear between its columns;
//                              −1: unknown beyond the ends, 0: constant there
//   data_1       double        constants: the abscissa's ends, then a row a constant, at both ends
//   data_2       double        the abscissa, then a row a quantity; a column a row of the table
//
// The layout is that of Dymola's manual and of Modelica's tools (DyMat, buildingspy), which read it by their MAT reader.
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

// The file's bytes; none: a matrix of version 5 has at most 2 GB. Columns of words and constants that are named as a column
// are left out.
std::optional<std::string> mat_file(const DataTable& table, const std::vector<MatConstant>& constants);

}  // namespace kurbel
