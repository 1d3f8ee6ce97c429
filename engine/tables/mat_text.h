// mat_text.h — a MAT file as text: a heading of its variables' names, then one line per row, cells separated by tabs.
//
// Version 5 ("MAT-File Format", The MathWorks), as save -v6 (plain) and -v7 (compressed) write it, in either order of bytes.
// A vector is a column; of a matrix m those of the file: m_1, m_2, …; single numbers, words, structures are omitted. Of
// results in Modelica's layout (Aclass, name, dataInfo, data_2) the quantities over the abscissa are the columns, with units.
#pragma once

#include <string>

namespace kurbel {

// All variables, or `variable` alone. What unpacks, and the resulting text, is limited to `limit` bytes. Throws SceneError
// for `path`: no MAT file, version 4 or 7.3, a damaged or truncated one, complex numbers, no variable of numbers.
std::string mat_as_text(const std::string& bytes, const std::string& variable, const std::string& path,
                        std::size_t limit);

}  // namespace kurbel
