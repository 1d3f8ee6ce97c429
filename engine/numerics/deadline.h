// deadline.h — how long a computation may take: asked in every loop whose length hangs on the scene.
//
//     const Deadline deadline(budget, interrupted);   // in force to the end of this block, in this thread
//     while (…) { Deadline::check(); … }              // anywhere below: throws OutOfTime
//
// Within another deadline both hold.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <string>

namespace kurbel {

// The time is up, or the user has interrupted. No runtime_error: what fails and is tried otherwise must not swallow it.
class OutOfTime : public std::exception {
 public:
  // `budget`: processor time that is spent [s]; 0: interrupted.
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

  // Costs some 30 ns; without a deadline nothing. Once over, every further look says so.
  static void check();

 private:
  void look();

  Deadline* outer_;
  double budget_, end_;  // [s]
  const std::atomic<bool>* interrupted_;
  std::chrono::steady_clock::time_point looked_;
  bool spent_ = false;
};

// Processor time of this thread [s]: what other threads compute meanwhile is not its own.
double processor_time();

}  // namespace kurbel
