// read_document.h — from a scene's document to a scene that can be built, for those who have no text.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// As parse_scene (read_scene.h) of the text that the document was made from; an empty text if there is none.
Scene scene_from(DocumentValue document, const std::string& text, const std::string& file,
                 const std::vector<Kind>& kinds, DataFiles allowed = DataFiles::below_the_scene);

}  // namespace kurbel
