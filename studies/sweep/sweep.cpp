// sweep.cpp — threads take rows by a counter, one writer commits finished rows.
#include "studies/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <future>
#include <mutex>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/scene/messages.h"
#include "studies/sweep/program_version.h"
#include "studies/variants/in_threads.h"

namespace kurbel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look{100}, between_commits{250};
constexpr std::size_t most_in_batch = 20'000;

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
    const std::size_t most = std::max<std::size_t>(end_.rows - end_.there, 1);
    const int threads = static_cast<int>(std::min(static_cast<std::size_t>(job_.jobs), most));
    std::future<bool> work = std::async(
        std::launch::async, [this, threads] { return in_threads(end_.rows, threads, [this] { return worker(); }); });
    try {
      collect(work);
    } catch (...) {  // the disk is full: nobody computes on
      stop_ = true;
      throw;
    }
    work.get();
    end_.seconds = seconds_since(begin_);
    return end_;
  }

 private:
  Worker worker() {
    return [this, evaluate = job_.evaluator()](std::size_t k) {
      if (stop_ || job_.watch.stopped()) return false;
      SweepRow row{.row = job_.shard - 1 + k * job_.shards};
      if (there_[row.row]) return true;
      row.parameters = job_.design->row(row.row);
      const double begin = processor_time();
      if (!evaluate(row)) return false;
      row.seconds = processor_time() - begin;
      const std::scoped_lock lock(mutex_);
      finished_.push_back(std::move(row));
      return true;
    };
  }

  void collect(const std::future<bool>& work) {
    Clock::time_point committed = Clock::now();
    for (bool at_work = true; at_work;) {
      at_work = work.wait_for(look) != std::future_status::ready;
      const std::size_t ready = count_finished();
      if (!at_work || Clock::now() - committed > between_commits || ready > most_in_batch) {
        commit();
        committed = Clock::now();
      }
      report(ready);
    }
  }

  std::size_t count_finished() {
    const std::scoped_lock lock(mutex_);
    return finished_.size();
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

  void report(std::size_t ready) const {
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
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::vector<SweepRow> finished_;
};

}  // namespace

void read_shard(const std::string& text, SweepJob& job) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), text.data() + slash, job.shard);
  const auto second = slash < text.size() ? std::from_chars(text.data() + slash + 1, end, job.shards) : first;
  if (first.ec != std::errc{} || first.ptr != text.data() + slash || second.ptr != end || slash == text.size() ||
      job.shard < 1 || job.shard > job.shards)
    throw std::invalid_argument(fmt::format("--shard {}: must be I/N with 1 ≤ I ≤ N, e.g. 3/64", in_quotes(text)));
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
