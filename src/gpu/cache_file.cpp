#include "gpu/cache_file.h"

#include "base/hash.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

namespace weft::gpu {
namespace {

// Header of the file, before the data.
struct Head {
    std::array<char, 8> magic{'w', 'e', 'f', 't', '-', 'p', 'c', '1'};
    std::uint64_t size = 0, hash = 0;
    friend bool operator==(const Head&, const Head&) = default;
};

Head head_of(std::span<const char> data) {
    StateHash hash;
    for (std::size_t at = 0; at < data.size(); at += sizeof(std::uint32_t)) {
        std::uint32_t word = 0;
        std::memcpy(&word, data.data() + at, std::min(sizeof word, data.size() - at));
        hash.add(word);
    }
    return {.size = data.size(), .hash = hash.value()};
}

}  // namespace

std::vector<char> read_cache_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    Head head;
    if (!in.read(reinterpret_cast<char*>(&head), sizeof head)) return {};
    std::vector<char> data(std::istreambuf_iterator<char>(in), {});
    if (head != head_of(data)) return {};
    return data;
}

bool write_cache_file(const std::filesystem::path& file, std::span<const char> data) {
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    static std::atomic<unsigned> writers = 0;  // one process may have several devices
    const std::filesystem::path part =
        file.string() + "." + std::to_string(::getpid()) + "." + std::to_string(++writers);
    const Head head = head_of(data);
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

}  // namespace weft::gpu
