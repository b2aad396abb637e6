#include "editor/app/choice_words.h"

#include "editor/app/property_tables.h"
#include "editor/ui/expression.h"
#include "scene/fabric.h"

#include <cmath>

namespace weft::editor {

std::vector<std::string_view> motion_words() {
    return {"stays where it is", "follows its keys", "a body that gravity and contact move"};
}

std::vector<std::string> preset_words(const std::string& place, const std::vector<std::string>& names) {
    if (pattern_of(place) != "/cloths/*/fabric") return {};
    std::vector<std::string> whats;
    for (const std::string& name : names) {
        const FabricPreset* const preset = find_fabric(name);
        const double grams = preset ? std::round(1000 * static_cast<double>(preset->fabric.body.density)) : 0;
        whats.push_back(format_number(grams, "g/m²"));
    }
    return whats;
}

}  // namespace weft::editor
