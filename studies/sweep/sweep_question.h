// sweep_question.h — a sweep over variants of a machine, as commands and the library request it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "studies/sweep/sweep.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/variants/machine.h"

namespace kurbel {

struct SweepRequest {
  MachineRequest machine = {};
  std::vector<std::string> vary = {}, figures = {}, limits = {};
  std::string variants = {}, design = {}, into = {}, shard = "1/1", xlsx = {};
  std::size_t errors_every = 1;
  int jobs = 0;
  std::uint64_t seed = 1;
};

struct FilledSweep {
  std::unique_ptr<SweepStore> store;
  SweepEnd end;
};
// Creates the file or continues it. All errors are reported before anything is written: std::invalid_argument, and
// SceneError for values that the scene refuses.
FilledSweep fill_sweep(const Inquiry& inquiry, const SweepRequest& asked);

// The report reads rows that are not held from the store.
struct StoredSweep {
  StoredSweep(std::unique_ptr<SweepStore> filled, const std::vector<std::string>& limits)
      : store(std::move(filled)), study(study_of(*store, limits)) {}
  std::unique_ptr<SweepStore> store;
  SweepStudyResult study;
};
StudyOutput output_of(std::shared_ptr<const StoredSweep> sweep);

}  // namespace kurbel
