// A 64-bit hash of words, for state hashes: the same on every machine, not cryptographic.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace weft {

/// FNV-1a over 32-bit words, with a final mix (Murmur3's) so that every input bit reaches every output bit.
class StateHash {
  public:
    void add(std::uint32_t word) { h_ = (h_ ^ word) * 0x100000001b3ull; }
    void add(float x) { add(std::bit_cast<std::uint32_t>(x)); }

    std::uint64_t value() const {
        std::uint64_t h = h_;
        h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
        h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
        return h ^ (h >> 33);
    }
    /// 16 hexadecimal digits.
    std::string text() const;

  private:
    std::uint64_t h_ = 0xcbf29ce484222325ull;
};

}  // namespace weft
