// data_files.h — which data files a scene may refer to.
#pragma once

namespace kurbel {

// An untrusted scene only those in its folder and below (SECURITY.md).
enum class DataFiles { below_the_scene, anywhere };

}  // namespace kurbel
