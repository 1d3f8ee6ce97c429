// study_options.h — options by their names, each asked for once; what nobody asks for is refused.
#pragma once

#include <kurbel/studies.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys.h"
#include "engine/scene/scene.h"

namespace kurbel {

// What a study does with these tells which options it has: made without a scene, it only notes the names.
class AskedOptions {
 public:
  AskedOptions(std::string study, const Options& given) : study_(std::move(study)), given_(given) {}

  // Empty: not given. Throws std::invalid_argument where it is given more than once.
  std::string text(const std::string& name);
  // All that are given under this name.
  std::vector<std::string> texts(const std::string& name);
  bool flag(const std::string& name);
  std::optional<int> whole(const std::string& name, int least, int most);
  // In SI; `example` shows the unit, `what` says what it must be.
  std::optional<double> quantity(const std::string& name, const std::string& what, const std::string& example,
                                 const Domain& domain = any_number);
  // Each of them, or joined by commas.
  std::vector<std::string> names(const std::string& name);
  std::vector<double> numbers(const std::string& name, double least, double most);
  std::vector<double> quantities(const std::string& name, const std::string& what, const std::string& example,
                                 const Domain& domain = any_number);
  std::optional<Effects> effects(const std::string& name, const Scene& scene);

  // Throws std::invalid_argument for an option that was not asked for.
  void refuse_others() const;
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::string study_;
  const Options& given_;
  std::vector<std::string> known_;
};

}  // namespace kurbel
