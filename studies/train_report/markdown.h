// markdown.h — a report as Markdown, and its sections for programs: the words and tables of the page; plots by their titles.
#pragma once

#include <string>

#include "studies/data/value.h"
#include "studies/findings/report.h"

namespace kurbel {

std::string markdown_of(const Report& report);

// Title and parts of each section: a table with its columns and rows as people read them, words, formulas, titles of drawings.
List sections_of(const Report& report);

}  // namespace kurbel
