// clear_away.h — what was replaced, and what writers that were killed have left; what is not kurbel's is never lost.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "studies/files/staging.h"

namespace kurbel {

// Every result set holds it: a first line by which the folder is known as kurbel's, then the files with their SHA-256.
inline constexpr const char* manifest_name = "set.sha256";
inline constexpr const char* manifest_begin = "# kurbel result set 1\n";

// The files that a folder's manifest names; nothing: it has none.
std::optional<std::set<std::string>> files_of_set(int folder);

// A folder of this process with all that is in it.
void delete_own(int parent, const std::string& name);

// Takes files that are not of the set over into `target`, deletes the set's own, then the folder. What cannot be taken
// over stays, and the folder with it. Any number of processes may do this at once.
void clear_replaced(int parent, const std::string& name, const std::string& target);

// In this folder: only what bears a staged name, belongs to this user and has no living writer. A set that was moved
// aside and not followed by another one is moved back.
void clear_abandoned(int parent);

}  // namespace kurbel
