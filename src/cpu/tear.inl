// Finds the triangles of a cloth whose load may soon exceed a limit. Included by passes.inl.

WEFT_FN TearSide load_side(const TearView& view, std::size_t side, std::size_t triangle) {
    const float* at = view.sides + WEFT_TEAR_SIDE_NUMBERS * side * view.stride + triangle;
    const std::size_t stride = view.stride;
    TearSide loaded;
    loaded.rest = load(at), loaded.pull = load(at + stride), loaded.push = load(at + 2 * stride);
    loaded.x = load(at + 3 * stride), loaded.y = load(at + 4 * stride), loaded.play = load(at + 5 * stride);
    return loaded;
}

WEFT_FN TearCoupling load_coupling(const TearView& view, std::size_t triangle) {
    const float* at = view.couplings + triangle;
    const std::size_t stride = view.stride;
    TearCoupling loaded;
    loaded.ab = load(at), loaded.bc = load(at + stride), loaded.ca = load(at + 2 * stride);
    loaded.ab_bc = load(at + 3 * stride), loaded.bc_ca = load(at + 4 * stride), loaded.ca_ab = load(at + 5 * stride);
    return loaded;
}

inline void watch_tears_pass(const TearView& view, float part, Range range) {
    const real limit(part);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        vec3 x[3];
        real unused;
        for (std::size_t k = 0; k < 3; ++k) x[k] = gather_blocks(view.position, view.faces + k * view.stride + i, unused);
        const TearSide sides[3] = {load_side(view, 0, i), load_side(view, 1, i), load_side(view, 2, i)};
        const TearFlat flat = lay_flat(x[0], x[1], x[2], sides[0], sides[1]);
        PlaneStress stress = springs_stress(flat, sides[0], sides[1], sides[2]);
        if (view.couplings)
            stress = add_stress(stress, coupling_stress(flat, sides[0], sides[1], sides[2], load_coupling(view, i)), real(1.0f));
        real strain(0.0f);
        for (std::size_t k = 0; k < 3; ++k) strain = max(strain, side_strain(x[k], x[(k + 1) % 3], sides[k]));
        const real radius = sqrt(stress.difference * stress.difference + stress.mixed * stress.mixed);
        const real strength = load(view.limits + i), stretch = load(view.limits + view.stride + i);
        const mask watched = (stress.mean + radius) * strength > limit || strain * stretch > limit;
        std::uint16_t& hot = view.hot[i / lane_padding];
        if (i % lane_padding == 0) hot = 0;
        hot = static_cast<std::uint16_t>(hot | bits_of(watched) << i % lane_padding);
    }
}
