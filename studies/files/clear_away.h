// clear_away.h — removes replaced result sets and remains of killed writers; files that are not kurbel's are never lost.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "studies/files/staging.h"

namespace kurbel {

// In every result set: a first line that marks the folder as kurbel's, then the files with their SHA-256.
inline constexpr const char* manifest_name = "set.sha256";
inline constexpr const char* manifest_begin = "# kurbel result set 1\n";

// The files named in a folder's manifest; empty: there is none.
std::optional<std::set<std::string>> files_of_set(int folder);

// Deletes a folder of this process with its contents.
void delete_own(int parent, const std::string& name);

// Moves files that are not of the set into `target`, deletes the set's own files, then the folder. Files that cannot
// be moved stay, and so does the folder. Safe for any number of concurrent processes.
void clear_replaced(int parent, const std::string& name, const std::string& target);

// Clears this folder: only entries with a staged name that belong to this user and have no living writer. A set that
// was moved aside without a successor is moved back.
void clear_abandoned(int parent);

}  // namespace kurbel
