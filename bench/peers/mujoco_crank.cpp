// mujoco_crank.cpp — the slider-crank as MuJoCo's format has it: two hinges, a slider, and a constraint that connects.
#include "bench/peers/mujoco_crank.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace kurbel::bench {

double mujoco_r1(double step) {
  const std::string path =
      (std::filesystem::temp_directory_path() / fmt::format("kurbel_mujoco_r1_{}.xml", getpid())).string();
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) throw std::runtime_error("mujoco_crank: cannot write " + path);
  std::fprintf(file,
               "<mujoco><option timestep='%.9g' integrator='RK4' gravity='0 0 0' solver='Newton' iterations='200' "
               "tolerance='1e-15'/><compiler angle='radian'/><worldbody>"
               "<body><joint name='crank' type='hinge' axis='0 0 1'/>"
               "<inertial pos='0 0 0' mass='1' diaginertia='0.3 0.3 0.55'/>"
               "<body name='rod' pos='0.1 0 0'><joint name='rod' type='hinge' axis='0 0 1'/>"
               "<inertial pos='0.1225 0 0' mass='2' diaginertia='0.011 0.011 0.02'/></body></body>"
               "<body name='slider' pos='0.45 0 0'><joint type='slide' axis='1 0 0'/>"
               "<inertial pos='0 0 0' mass='3' diaginertia='0.01 0.01 0.01'/></body></worldbody>"
               "<equality><connect body1='rod' body2='slider' anchor='0.35 0 0' solref='-1e7 -2e3' "
               "solimp='0.9999 0.9999 0.001 0.5 2'/></equality></mujoco>",
               step);
  std::fclose(file);
  char error[500] = "";
  mjModel* model = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
  std::remove(path.c_str());
  if (!model) throw std::runtime_error(std::string("mujoco_crank: ") + error);
  mjData* data = mj_makeData(model);
  data->qvel[0] = 30;
  data->qvel[1] = -30 * (1 + 0.1 / 0.35);
  const long steps = std::lround(10 / step);
  for (long i = 0; i < steps; ++i) mj_step(model, data);
  const double phi = data->qpos[0];
  mj_deleteData(data);
  mj_deleteModel(model);
  return phi;
}

}  // namespace kurbel::bench
