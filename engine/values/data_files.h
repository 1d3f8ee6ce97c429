// data_files.h — which data files a scene may have read.
#pragma once

namespace kurbel {

// A scene from a stranger only those in its own folder and below (SECURITY.md).
enum class DataFiles { below_the_scene, anywhere };

}  // namespace kurbel
