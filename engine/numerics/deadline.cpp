// deadline.cpp — the deadlines of a thread as a chain, the innermost first.
#include "engine/numerics/deadline.h"

#include <fmt/format.h>

#include <ctime>

namespace kurbel {
namespace {

thread_local Deadline* innermost = nullptr;

// The processor's clock is asked no more often: it costs ten times the other one.
constexpr auto between_looks = std::chrono::milliseconds(1);

}  // namespace

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

OutOfTime::OutOfTime(double budget)
    : budget_(budget),
      what_(budget == 0 ? "interrupted" : fmt::format("the budget of {} s of processor time is spent", budget)) {}

Deadline::Deadline(double budget, const std::atomic<bool>* interrupted)
    : outer_(innermost),
      budget_(budget),
      end_(processor_time() + budget),
      interrupted_(interrupted),
      looked_(std::chrono::steady_clock::now()) {
  innermost = this;
}

Deadline::~Deadline() { innermost = outer_; }

void Deadline::check() {
  if (innermost) innermost->look();
}

void Deadline::look() {
  for (const Deadline* d = this; d; d = d->outer_) {
    if (d->interrupted_ && d->interrupted_->load(std::memory_order_relaxed)) throw OutOfTime(0);
    if (d->spent_) throw OutOfTime(d->budget_);
  }
  const auto wall = std::chrono::steady_clock::now();
  if (wall - looked_ < between_looks) return;
  looked_ = wall;
  const double now = processor_time();
  for (Deadline* d = this; d; d = d->outer_)
    if (now >= d->end_) {
      d->spent_ = true;
      throw OutOfTime(d->budget_);
    }
}

}  // namespace kurbel
