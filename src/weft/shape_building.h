// Builds the data of collider shapes that have some.
#pragma once

#include "collide/body_features.h"
#include "collide/shape_data.h"
#include "weft/cloth_building.h"
#include "weft/field_cache.h"

#include <weft/result.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Colliders with the same shape share its data.
class ShapeLibrary {
  public:
    /// `threads`: that build shapes, the calling one included.
    explicit ShapeLibrary(unsigned threads = 1, FieldCache fields = FieldCache())
        : threads_(threads), fields_(std::move(fields)) {}

    /// The data of the collider's shape; null if it has none. Reads the shape's mesh file, if it names one. `pointer`:
    /// the place of the collider in errors. Appends one line per warning to `notes`.
    Result<std::shared_ptr<const ShapeData>> data_of(const ColliderDesc& collider, const MeshFiles& files,
                                                     const std::string& pointer, std::vector<std::string>& notes);

  private:
    struct Entry {
        ColliderShape shape;  ///< without its contact
        std::weak_ptr<const ShapeData> data;
    };
    unsigned threads_;
    FieldCache fields_;
    std::vector<Entry> known_;
};

/// The surface that cloth with exact contact meets instead of the collider's shape; null if there is none. `data`: of
/// the collider's shape. `pointer`: the place of the collider in errors.
Result<std::shared_ptr<const ClothModel>> surface_of(const ColliderDesc& collider, const ShapeData* data,
                                                     const std::string& pointer, std::vector<std::string>& notes);

}  // namespace weft
