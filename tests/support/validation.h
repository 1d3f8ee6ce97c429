// validation.h — compares a number with an external reference, and adds its row to docs/validation.md.
//
// A test that follows a published case or a closed form declares it here and is then listed on the page:
//
//     test::Validation khurmi(test::Against::published, "Khurmi, Gupta: Theory of Machines, ex. 12.3");
//     khurmi.close("contact ratio", "", pair.contact_ratio, 1.4751556141, 1e-6);
//
// Each line is an expectation of the test, and a row of the page. The page is written by the tests themselves
// (scripts/renew-docs); in every other run the existing row must equal the test's.
#pragma once

#include <optional>
#include <string>

#include "studies/findings/result.h"

namespace kurbel::test {

// Source of a reference number. The page has a chapter for each.
enum class Against {
  published,    // printed in a book, a standard, a paper, a benchmark
  closed_form,  // a formula, evaluated by hand or in the test
  reference,    // the test's own equations of motion, integrated or summed by other means
};

// One source, and the reference numbers that a test takes from it.
class Validation {
 public:
  Validation(Against against, std::string source) : against_(against), source_(std::move(source)) {}

  // |found − expected| ≤ within, all in the named unit; `error` is the error stated by kurbel.
  void near(const std::string& what, const std::string& unit, double found, double expected, double within,
            std::optional<double> error = {}) const;
  // The same, `relative` to the expected number.
  void close(const std::string& what, const std::string& unit, double found, double expected, double relative,
             std::optional<double> error = {}) const;
  // A figure in SI and its error, both divided by `scale`, the size of the named unit [SI].
  void near(const std::string& what, const std::string& unit, double scale, const Figure* figure, double expected,
            double within) const;

 private:
  Against against_;
  std::string source_;
};

}  // namespace kurbel::test
