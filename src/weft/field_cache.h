// Keeps distance fields on disk, so that the same mesh needs no time at the next start.
#pragma once

#include "collide/distance_field.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace weft {

class FieldCache {
  public:
    /// What a field depends on.
    struct Key {
        std::uint64_t hash = 0;   ///< of the vertices, the triangles, the resolution and distance_field_version
        std::uint64_t check = 0;  ///< a second hash of the same; not part of the file's name
        std::string file_name() const;
        friend bool operator==(const Key&, const Key&) = default;
    };
    static Key key_of(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::uint32_t cells);

    /// `folder` is created when it is needed. Empty: nothing is kept. When the fields in it are larger than
    /// `largest_bytes`, write() removes those that were written first.
    explicit FieldCache(std::filesystem::path folder = {}, std::uintmax_t largest_bytes = std::uintmax_t{1} << 30)
        : folder_(std::move(folder)), largest_bytes_(largest_bytes) {}

    /// Returns nothing if there is no such field, or if its file is damaged or belongs to another mesh or version.
    std::optional<DistanceField> read(const Key& key) const;
    /// Does nothing if the file cannot be written.
    void write(const Key& key, const DistanceField& field) const;

  private:
    void remove_oldest(const std::filesystem::path& except) const;

    std::filesystem::path folder_;
    std::uintmax_t largest_bytes_;
};

}  // namespace weft
