#include "base/cache_file.h"

#include "base/hash.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace weft {
namespace {

// Header of the file, before the data.
struct Head {
    std::array<char, 8> format{};
    std::uint64_t size = 0, hash = 0;
    friend bool operator==(const Head&, const Head&) = default;
};

Head head_of(CacheFormat format, std::span<const char> data) {
    StateHash hash;
    for (std::size_t at = 0; at < data.size(); at += sizeof(std::uint32_t)) {
        std::uint32_t word = 0;
        std::memcpy(&word, data.data() + at, std::min(sizeof word, data.size() - at));
        hash.add(word);
    }
    Head head{.size = data.size(), .hash = hash.value()};
    std::copy_n(format.begin(), std::min(format.size(), head.format.size()), head.format.begin());
    return head;
}

}  // namespace

std::filesystem::path cache_folder() {
    if (const char* own = std::getenv("WEFT_CACHE")) return own;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return std::filesystem::path(cache) / "weft";
    if (const char* home = std::getenv("HOME"); home && *home) return std::filesystem::path(home) / ".cache" / "weft";
    return {};
}

std::vector<char> read_cache_file(const std::filesystem::path& file, CacheFormat format) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    Head head;
    if (error || !in.read(reinterpret_cast<char*>(&head), sizeof head)) return {};
    if (head.size != size - sizeof head) return {};
    std::vector<char> data(head.size);
    if (!in.read(data.data(), static_cast<std::streamsize>(data.size()))) return {};
    if (head != head_of(format, data)) return {};
    return data;
}

bool write_cache_file(const std::filesystem::path& file, CacheFormat format, std::span<const char> data) {
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    static std::atomic<unsigned> writers = 0;  // one process may have several devices
    const std::filesystem::path part =
        file.string() + "." + std::to_string(::getpid()) + "." + std::to_string(++writers);
    const Head head = head_of(format, data);
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&head), sizeof head);
    out.write(data.data(), static_cast<std::streamsize>(data.size()));
    out.close();
    bool written = out.good();
    if (written) {
        std::filesystem::rename(part, file, error);
        written = !error;
    }
    if (!written) std::filesystem::remove(part, error);
    return written;
}

}  // namespace weft
