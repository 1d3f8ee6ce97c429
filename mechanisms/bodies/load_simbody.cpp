// load_simbody.cpp — loads the module that is linked with Simbody. Its libraries take the dynamic linker 23 million instructions,
// more than all the rest of a start: commands that need no bodies do without them.
#include <dlfcn.h>
#include <fmt/core.h>
#include <kurbel_simbody_module_image.h>  // its checksum: a cache of objects sees no other change
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "engine/base/embedded.h"
#include "mechanisms/bodies/simbody_module.h"

KURBEL_EMBEDDED(kurbel_simbody_image, KURBEL_SIMBODY_IMAGE);

namespace kurbel {
namespace {

[[noreturn]] void fail(const std::string& why) {
  if (why.find(std::strerror(ENOMEM)) != std::string::npos) throw std::bad_alloc();
  throw std::runtime_error(
      fmt::format("Simbody's libraries, which a mechanism's bodies need, cannot be loaded: {}", why));
}

// A file in memory: the program has one file, wherever it is installed.
const SimbodyModule& loaded() {
  const int file = memfd_create("kurbel_simbody", MFD_CLOEXEC);
  if (file < 0) fail(std::strerror(errno));
  for (const char* at = kurbel_simbody_image_begin; at != kurbel_simbody_image_end;) {
    const ssize_t written = write(file, at, static_cast<std::size_t>(kurbel_simbody_image_end - at));
    if (written < 0 && errno != EINTR) {
      const std::string why = std::strerror(errno);
      close(file);
      fail(why);
    }
    if (written > 0) at += written;
  }
  void* const module = dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_LAZY | RTLD_LOCAL);
  close(file);
  if (!module) fail(dlerror());
  return *static_cast<const SimbodyModule*>(dlsym(module, "kurbel_simbody_module"));
}

const SimbodyModule& simbody_module() {
  static const SimbodyModule& module = loaded();
  return module;
}

}  // namespace

std::unique_ptr<MechanismBodies> make_bodies(const BodiesOf& of) { return simbody_module().bodies(of); }
MultibodyResult run_multibody(const MultibodyProblem& problem) { return simbody_module().run(problem); }
std::vector<std::string> multibody_integrators() { return simbody_module().integrators(); }

}  // namespace kurbel
