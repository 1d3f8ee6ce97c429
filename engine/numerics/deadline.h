// deadline.h — time limit of a computation, checked in every loop whose length depends on the scene.
//
//     const Deadline deadline(budget, interrupted);   // valid to the end of this block, in this thread
//     while (…) { Deadline::check(); … }              // in any function called: throws OutOfTime
//
// Within another deadline both apply.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <string>

namespace kurbel {

// The time is over, or the user has interrupted. Not a runtime_error, so that handlers of failures do not catch it.
class OutOfTime : public std::exception {
 public:
  // `budget`: exceeded processor time [s]; 0: interrupted.
  explicit OutOfTime(double budget);
  const char* what() const noexcept override { return what_.c_str(); }
  bool interrupted() const { return budget_ == 0; }
  double budget() const { return budget_; }

 private:
  double budget_;
  std::string what_;
};

class Deadline {
 public:
  explicit Deadline(double budget, const std::atomic<bool>* interrupted = nullptr);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  // Takes some 30 ns; without a deadline nothing. After the deadline every check throws.
  static void check();

 private:
  void look();

  Deadline* outer_;
  double budget_, end_;  // [s]
  const std::atomic<bool>* interrupted_;
  std::chrono::steady_clock::time_point looked_;
  bool spent_ = false;
};

// Processor time of this thread only [s].
double processor_time();

}  // namespace kurbel
