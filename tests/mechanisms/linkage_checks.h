// linkage_checks.h — what holds of every linkage: its joints stay closed, and both extractions agree.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel::test {

inline constexpr int sample_channels = 8;

inline std::vector<double> values_in(const ReducedSample& s) {
  return {s.inertia,         s.inertia_slope,         s.inertia_curvature,
          s.output_position, s.output_velocity_ratio, s.output_acceleration_ratio,
          s.gravity_torque,  s.gravity_torque_slope};
}

inline void expect_valid(const LinkageData& data) {
  for (const LinkageFault& fault : data.linkage->faults()) ADD_FAILURE() << fault.at << ": " << fault.text;
}

// Simbody's bodies and the series agree within this part of each channel's largest value.
inline void expect_both_extractions(const LinkageData& data, double within, int samples = 60) {
  expect_valid(data);
  if (!data.linkage->faults().empty()) return;
  const auto bodies = make_bodies(data);
  const MechanismData as_data(data);
  double scale[sample_channels] = {};
  std::vector<ReducedSample> first, second;
  const auto arc = data.linkage->arc();
  for (int i = 0; i < samples; ++i) {
    const double part = (i + 0.37) / samples;
    const double phi =
        arc ? arc->middle + 0.9 * arc->half * (2 * part - 1) : 2 * std::numbers::pi * data.linkage->turns() * part;
    first.push_back(bodies->sample(phi)), second.push_back(closed_sample(as_data, phi));
    const std::vector<double> values = values_in(second.back());
    for (int c = 0; c < sample_channels; ++c)
      scale[c] = std::max(scale[c], std::abs(values[static_cast<std::size_t>(c)]));
    scale[6] = std::max(scale[6], second.back().gravity_torque_scale);
  }
  scale[1] = std::max(scale[1], 0.1 * scale[0]), scale[2] = std::max(scale[2], scale[0]);
  scale[4] = std::max(scale[4], 1e-3 * scale[3]);  // what hardly moves has the rounding of its place
  scale[5] = std::max(scale[5], 0.1 * scale[4]);
  scale[7] = std::max(scale[7], scale[6]);
  if (data.linkage->sketch().output.rocks()) scale[3] = std::max(scale[3], 1.0);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::vector<double> a = values_in(first[i]), b = values_in(second[i]);
    for (std::size_t c = 0; c < sample_channels; ++c) {
      double off = a[c] - b[c];
      if (c == 3 && data.linkage->sketch().output.rocks()) off = std::remainder(off, 2 * std::numbers::pi);
      EXPECT_LE(std::abs(off), within * scale[c]) << "channel " << c << ", sample " << i;
    }
  }
}

// All distances of points on one link are those of the sketch.
inline void expect_rigid(const LinkageData& data) {
  expect_valid(data);
  if (!data.linkage->faults().empty()) return;
  const Linkage& l = *data.linkage;
  long double longest = 0, off = 0;
  for (int i = 0; i < 50; ++i) {
    const auto arc = l.arc();
    const long double part = (i + 0.37L) / 50;
    const LinkPoses poses =
        l.poses(arc ? arc->middle + 0.9L * arc->half * (2 * part - 1) : 2 * std::numbers::pi * l.turns() * part);
    // Every joint holds, seen from both of its links.
    for (const LinkageJoint& j : l.structure().joints) {
      const LinkPose &a = poses[j.a], &b = poses[j.b];
      longest = std::max(longest, length(j.at));
      const Path apart = b(j.at) - a(j.at);
      if (!j.slides) {
        for (int k = 0; k <= Taylor::order; ++k)
          off =
              std::max({off, std::fabs(apart.x.c[k]) * std::pow(0.1L, k), std::fabs(apart.y.c[k]) * std::pow(0.1L, k)});
      } else {
        off = std::max(off, std::fabs(cross(poses[j.other(j.carrier)].turned(j.along), apart).value()));
        off =
            std::max(off, std::fabs(a.turn.cos.value() * b.turn.sin.value() - a.turn.sin.value() * b.turn.cos.value()));
      }
    }
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const Direction& turn = poses[static_cast<int>(k)].turn;
      off = std::max(off, std::fabs(std::hypot(turn.cos.value(), turn.sin.value()) - 1));
    }
  }
  EXPECT_LE(off, 1e-13L * longest);
}

}  // namespace kurbel::test
