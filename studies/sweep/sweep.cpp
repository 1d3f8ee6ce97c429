// sweep.cpp — threads take rows by a counter, one writer commits what they have finished.
#include "studies/sweep/sweep.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "engine/scene/messages.h"
#include "studies/sweep/program_version.h"

namespace kurbel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look{100}, between_commits{250};
constexpr std::size_t most_in_batch = 20'000;

double thread_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::string time_left(double seconds) {
  if (!(seconds < 1e7)) return "—";
  return seconds < 100   ? fmt::format("{:.0f} s", seconds)
         : seconds < 6e3 ? fmt::format("{:.0f} min", seconds / 60)
                         : fmt::format("{:.1f} h", seconds / 3600);
}

class Sweeping {
 public:
  Sweeping(const SweepJob& job, SweepStore& store) : job_(job), store_(store), there_(store.rows_there()) {
    for (std::size_t i = job.shard - 1; i < job.design->rows(); i += job.shards) ++end_.rows, end_.there += there_[i];
  }

  SweepEnd run() {
    const auto threads = std::clamp<std::size_t>(static_cast<std::size_t>(job_.jobs), 1,
                                                 std::max<std::size_t>(end_.rows - end_.there, 1));
    working_ = threads;
    std::vector<std::jthread> workers;
    for (std::size_t k = 0; k < threads; ++k) workers.emplace_back([this] { work(); });
    try {
      collect();
    } catch (...) {  // the disk is full: nobody computes on
      stop_ = true;
      throw;
    }
    workers.clear();
    if (thrown_) std::rethrow_exception(thrown_);
    end_.seconds = seconds_since(begin_);
    return end_;
  }

 private:
  void work() {
    try {
      const Evaluator evaluate = job_.evaluator();
      for (std::size_t k = next_++; k < end_.rows && !stop_ && !job_.watch.stopped(); k = next_++) {
        SweepRow row{.row = job_.shard - 1 + k * job_.shards};
        if (there_[row.row]) continue;
        row.parameters = job_.design->row(row.row);
        const double begin = thread_time();
        if (!evaluate(row)) break;
        row.seconds = thread_time() - begin;
        const std::scoped_lock lock(mutex_);
        finished_.push_back(std::move(row));
      }
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      stop_ = true;
    }
    const std::scoped_lock lock(mutex_);
    --working_;
    ended_.notify_one();
  }

  void collect() {
    Clock::time_point committed = Clock::now();
    for (bool at_work = true; at_work;) {
      std::size_t ready = 0;
      {
        std::unique_lock lock(mutex_);
        ended_.wait_for(lock, look, [&] { return working_ == 0; });
        at_work = working_ > 0;
        ready = finished_.size();
      }
      if (!at_work || Clock::now() - committed > between_commits || ready > most_in_batch) {
        commit();
        committed = Clock::now();
      }
      tell(ready);
    }
  }

  void commit() {
    std::vector<SweepRow> batch;
    {
      const std::scoped_lock lock(mutex_);
      batch.swap(finished_);
    }
    store_.write(batch);
    end_.computed += batch.size();
    for (const SweepRow& r : batch) end_.failed += r.state == RowState::failed;
  }

  void tell(std::size_t ready) const {
    const std::size_t computed = end_.computed + ready, done = end_.there + computed;
    const double rate = static_cast<double>(computed) / std::max(seconds_since(begin_), 1e-3);
    job_.watch.at(fmt::format("sweep: {} of {}, {:.3g}/s, {} failed, {} left", done, end_.rows, rate, end_.failed,
                              time_left(static_cast<double>(end_.rows - done) / rate)),
                  static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(end_.rows, 1)));
  }

  const SweepJob& job_;
  SweepStore& store_;
  SweepEnd end_;
  Clock::time_point begin_ = Clock::now();
  const std::vector<bool> there_;  // a bit a row: a million rows are no burden
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::vector<SweepRow> finished_;
  std::size_t working_ = 0;
  std::exception_ptr thrown_;
};

}  // namespace

int threads_of(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void read_shard(const std::string& option, const std::string& text, SweepJob& job) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), text.data() + slash, job.shard);
  const auto second = slash < text.size() ? std::from_chars(text.data() + slash + 1, end, job.shards) : first;
  if (first.ec != std::errc{} || first.ptr != text.data() + slash || second.ptr != end || slash == text.size() ||
      job.shard < 1 || job.shard > job.shards)
    throw std::invalid_argument(fmt::format("{} {}: must be I/N with 1 ≤ I ≤ N, e.g. 3/64", option, in_quotes(text)));
}

std::string joined_lines(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + "\n";
  return all;
}

SweepIdentity identity_of(const Design& design, std::vector<SweptFigure> figures, const std::string& shard,
                          std::map<std::string, std::string> meta) {
  std::vector<std::string> varied, names;
  for (const SweptParameter& parameter : design.parameters()) varied.push_back(parameter.given);
  for (const SweptFigure& figure : figures) names.push_back(figure.name);
  meta.insert({{"version", program_version()},
               {"design", design.text()},
               {"varied", joined_lines(varied)},
               {"figures", joined_lines(names)}});
  return {.meta = std::move(meta),
          .shard = shard,
          .parameters = design.parameters(),
          .figures = std::move(figures),
          .rows = design.rows()};
}

SweepEnd run_sweep(const SweepJob& job, SweepStore& store) { return Sweeping(job, store).run(); }

}  // namespace kurbel
