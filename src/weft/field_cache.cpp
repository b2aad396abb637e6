#include "weft/field_cache.h"

#include "base/cache_file.h"
#include "base/hash.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace fs = std::filesystem;
namespace {

constexpr CacheFormat field_format = "weft-df1";
constexpr const char* ending = ".field";

// The start of the file's data. The words of the field follow.
struct FieldHead {
    FieldCache::Key key;
    std::uint32_t version = distance_field_version;
    float cell = 0, steepness = 0;
    std::array<std::uint32_t, 3> places{};
    std::uint32_t bricks = 0, zero_area = 0, flipped = 0;
    std::uint32_t closed = 0, has_inside = 0;
    std::uint32_t samples = 0, thin = 0;
    float least_thickness = 0;
    Vec3 place{}, low{}, high{};
    std::uint32_t is_sheet = 0;
    std::uint64_t words = 0;
};
static_assert(std::is_trivially_copyable_v<FieldHead>);
// The bytes of padding would have any value, and files of the same field would differ.
static_assert(sizeof(FieldHead) == sizeof(FieldCache::Key) + 24 * sizeof(float) + sizeof(FieldHead::words));

StateHash hash_of(std::uint32_t seed, std::span<const Vec3> positions, std::span<const Triangle> triangles,
                  std::uint32_t cells) {
    StateHash hash;
    for (const std::uint32_t word : {seed, distance_field_version, cells, static_cast<std::uint32_t>(positions.size()),
                                     static_cast<std::uint32_t>(triangles.size())})
        hash.add(word);
    for (const Vec3 p : positions) hash.add(p.x), hash.add(p.y), hash.add(p.z);
    for (const auto& [a, b, c] : triangles) hash.add(a), hash.add(b), hash.add(c);
    return hash;
}

FieldHead head_of(const FieldCache::Key& key, const DistanceField& field) {
    return {.key = key,
            .cell = field.cell,
            .steepness = field.data.steepness,
            .places = field.places,
            .bricks = field.bricks,
            .zero_area = field.zero_area,
            .flipped = field.flipped,
            .closed = field.closed,
            .has_inside = field.has_inside,
            .samples = field.thin.samples,
            .thin = field.thin.thin,
            .least_thickness = field.thin.least_thickness,
            .place = field.thin.place,
            .low = field.data.bounds.min,
            .high = field.data.bounds.max,
            .is_sheet = field.is_sheet,
            .words = field.data.words.size()};
}

DistanceField field_from(const FieldHead& head) {
    DistanceField field;
    field.cell = head.cell;
    field.data.steepness = head.steepness;
    field.data.width = field_width(field.cell);
    field.places = head.places;
    field.bricks = head.bricks;
    field.zero_area = head.zero_area;
    field.flipped = head.flipped;
    field.closed = head.closed != 0;
    field.is_sheet = head.is_sheet != 0;
    field.has_inside = head.has_inside != 0;
    field.thin = {head.samples, head.thin, head.least_thickness, head.place};
    field.data.bounds = {head.low, head.high};
    return field;
}

}  // namespace

std::string FieldCache::Key::file_name() const {
    constexpr char digits[] = "0123456789abcdef";
    std::string name(16, '0');
    for (std::size_t k = 0; k < 16; ++k) name[15 - k] = digits[hash >> (4 * k) & 15];
    return name + ending;
}

FieldCache::Key FieldCache::key_of(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                   std::uint32_t cells) {
    return {hash_of(1, positions, triangles, cells).value(), hash_of(2, positions, triangles, cells).value()};
}

std::optional<DistanceField> FieldCache::read(const Key& key) const {
    if (folder_.empty()) return std::nullopt;
    const std::vector<char> data = read_cache_file(folder_ / key.file_name(), field_format);
    FieldHead head;
    if (data.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, data.data(), sizeof head);
    if (head.key != key || head.version != distance_field_version) return std::nullopt;
    if (head.words != (data.size() - sizeof head) / sizeof(float)) return std::nullopt;
    DistanceField field = field_from(head);
    field.data.words.resize(head.words);
    std::memcpy(field.data.words.data(), data.data() + sizeof head, head.words * sizeof(float));
    return field;
}

void FieldCache::write(const Key& key, const DistanceField& field) const {
    if (folder_.empty()) return;
    const FieldHead head = head_of(key, field);
    std::vector<char> data(sizeof head + field.bytes());
    std::memcpy(data.data(), &head, sizeof head);
    std::memcpy(data.data() + sizeof head, field.data.words.data(), field.bytes());
    const fs::path file = folder_ / key.file_name();
    if (write_cache_file(file, field_format, data)) remove_oldest(file);
}

void FieldCache::remove_oldest(const fs::path& except) const {
    struct Kept {
        fs::file_time_type time;
        std::uintmax_t size;
        fs::path file;
    };
    std::vector<Kept> kept;
    std::uintmax_t bytes = 0;
    std::error_code error;
    // Another process may remove files at the same time; those are skipped.
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code gone;
        if (entry->path().extension() != ending) continue;
        const Kept file{entry->last_write_time(gone), gone ? 0 : entry->file_size(gone), entry->path()};
        if (gone) continue;
        bytes += file.size;
        if (file.file != except) kept.push_back(file);
    }
    std::ranges::sort(kept, {}, [](const Kept& file) { return std::pair(file.time, file.file); });
    for (const Kept& file : kept) {
        if (bytes <= largest_bytes_) return;
        fs::remove(file.file, error);
        bytes -= file.size;
    }
}

}  // namespace weft
