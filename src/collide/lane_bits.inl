// Lanes as bits, for the lanes of the including namespace. Include physics/kernels.inl before.

// Calls visit(lane) for every set bit.
template <class Visit>
WEFT_FN void for_each_bit(std::uint32_t bits, Visit&& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

// The bits of the lanes from `begin` on that are below `end`.
WEFT_FN std::uint32_t lanes_before(std::uint32_t begin, std::uint32_t end) {
    return end - begin < lane_count ? (1u << (end - begin)) - 1 : ~0u;
}
