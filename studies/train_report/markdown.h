// markdown.h — a report as Markdown, and its sections for programs: texts and tables of the page; plots by their titles.
#pragma once

#include <string>

#include "studies/data/value.h"
#include "studies/findings/report.h"

namespace kurbel {

std::string markdown_of(const Report& report);

// Title and parts of each section: tables with columns and rows in readable form, texts, formulas, titles of drawings.
List sections_of(const Report& report);

}  // namespace kurbel
