// Solves lines of stretch constraints, one line per lane. Included by passes.inl.

// Values that elimination stores for back substitution, constraint by constraint, as vectors of lane_count floats.
struct LineScratch {
    float* at;

    WEFT_FN float* entry(std::size_t row, std::size_t field) const {
        return at + (row * line_scratch_fields + field) * static_cast<std::size_t>(lane_count);
    }
    WEFT_FN void keep_row(std::size_t row, const LineRow& r) const {
        store(r.n.x, entry(row, 0)), store(r.n.y, entry(row, 1)), store(r.n.z, entry(row, 2));
        store(r.g, entry(row, 3)), store(r.limit, entry(row, 5));
    }
    WEFT_FN void keep_factor(std::size_t row, real factor) const { store(factor, entry(row, 4)); }
    WEFT_FN LineRow row(std::size_t row) const {
        LineRow r = line_start();
        r.n = vec3(load(entry(row, 0)), load(entry(row, 1)), load(entry(row, 2)));
        r.g = load(entry(row, 3)), r.factor = load(entry(row, 4)), r.limit = load(entry(row, 5));
        return r;
    }
    WEFT_FN void keep_point(std::size_t row, vec3 x, real w) const {
        store(x.x, entry(row, 6)), store(x.y, entry(row, 7)), store(x.z, entry(row, 8)), store(w, entry(row, 9));
    }
    WEFT_FN vec3 point(std::size_t row, real& w) const {
        w = load(entry(row, 9));
        return vec3(load(entry(row, 6)), load(entry(row, 7)), load(entry(row, 8)));
    }
};

template <LambdaUse use>
inline void lines_of_block(const ParticleView& p, const RowView& rows, std::size_t begin, std::size_t length,
                           const Step& step, const LineScratch& scratch) {
    const std::uint32_t* second = rows.particles + rows.stride;
    real wa, wb;
    vec3 a = gather_blocks(p.position, rows.particles + begin, wa);
    LineRow before = line_start();
    for (std::size_t k = 0; k < length; ++k) {
        const std::size_t r = begin + k * lane_padding;
        const vec3 b = gather_blocks(p.position, second + r, wb);
        const real lambda = use == LambdaUse::accumulate ? load(rows.lambda + r) : real(0.0f);
        const LineRow now = eliminate_stretch(before, a, b, wa, wb, lambda,
                                              StretchTraits::load_row(rows.fields + r, rows.stride), step);
        if (k > 0) scratch.keep_factor(k - 1, before.factor);
        scratch.keep_row(k, now);
        scratch.keep_point(k, a, wa);
        before = now, a = b, wa = wb;
    }
    scratch.keep_factor(length - 1, real(0.0f));

    vec3 pull(real(0.0f));  // of the constraint processed before
    real next = real(0.0f);
    for (std::size_t k = length; k-- > 0;) {
        const std::size_t r = begin + k * lane_padding;
        const LineRow row = scratch.row(k);
        next = substitute_stretch(row, next);
        if (use == LambdaUse::store) store(next, rows.lambda + r);
        if (use == LambdaUse::accumulate) store(load(rows.lambda + r) + next, rows.lambda + r);
        const vec3 mine = row.n * next;
        scatter_blocks(a + (pull - mine) * wa, wa, p.position, second + r);
        pull = mine;
        a = scratch.point(k, wa);
    }
    scatter_blocks(a + pull * wa, wa, p.position, rows.particles + begin);
}

// Whether all lines go on from the constraint before row `r` to that at row `r`.
WEFT_FN bool all_go_on(const std::uint32_t* first, const std::uint32_t* second, std::size_t r) {
    constexpr std::uint32_t all = (std::uint32_t{2} << (lane_count - 1)) - 1;
    return bits_of(same_index(first + r, second + r - lane_padding)) == all;
}

// The same for a block in which lines end: a constraint may begin at another particle than that at which the one before
// it ends. Few do, so where all lines go on, particles are read and written once, as above. Gives the bits of
// lines_of_block() where the particles are the same.
template <LambdaUse use>
inline void lines_of_cut_block(const ParticleView& p, const RowView& rows, std::size_t begin, std::size_t length,
                               const Step& step, const LineScratch& scratch) {
    const std::uint32_t *first = rows.particles, *second = rows.particles + rows.stride;
    LineRow before = line_start();
    real wa, wb;
    vec3 a = gather_blocks(p.position, first + begin, wa);
    for (std::size_t k = 0; k < length; ++k) {
        const std::size_t r = begin + k * lane_padding;
        if (k > 0 && !all_go_on(first, second, r)) {
            a = gather_blocks(p.position, first + r, wa);
            before.n = select(same_index(first + r, second + r - lane_padding), before.n, vec3(real(0.0f)));
        }
        const vec3 b = gather_blocks(p.position, second + r, wb);
        const real lambda = use == LambdaUse::accumulate ? load(rows.lambda + r) : real(0.0f);
        const LineRow now = eliminate_stretch(before, a, b, wa, wb, lambda,
                                              StretchTraits::load_row(rows.fields + r, rows.stride), step);
        if (k > 0) scratch.keep_factor(k - 1, before.factor);
        scratch.keep_row(k, now);
        scratch.keep_point(k, a, wa);
        before = now, a = b, wa = wb;
    }
    scratch.keep_factor(length - 1, real(0.0f));

    vec3 pull(real(0.0f));  // of the constraint processed before
    real next = real(0.0f);
    for (std::size_t k = length; k-- > 0;) {
        const std::size_t r = begin + k * lane_padding, after = r + lane_padding;
        const LineRow row = scratch.row(k);
        next = substitute_stretch(row, next);
        if (use == LambdaUse::store) store(next, rows.lambda + r);
        if (use == LambdaUse::accumulate) store(load(rows.lambda + r) + next, rows.lambda + r);
        const vec3 mine = row.n * next;
        if (k + 1 == length || all_go_on(first, second, after)) {
            scatter_blocks(a + (pull - mine) * wa, wa, p.position, second + r);
        } else {
            real w;
            const vec3 end = gather_blocks(p.position, second + r, w);  // no constraint has moved it yet
            scatter_blocks(a + pull * wa, wa, p.position, first + after);
            const mask goes_on = same_index(first + after, second + r);
            scatter_blocks(end + (select(goes_on, pull, vec3(real(0.0f))) - mine) * w, w, p.position, second + r);
        }
        pull = mine;
        a = scratch.point(k, wa);
    }
    scatter_blocks(a + pull * wa, wa, p.position, first + begin);
}

template <LambdaUse use>
inline void lines_of(const ParticleView& p, const RowView& rows, std::span<const LineBlock> blocks, float h,
                     float* scratch) {
    const Step step = make_step(h);
    for (const LineBlock& block : blocks) {
        for (std::size_t lane = 0; lane < lane_padding; lane += lane_count) {
            if (block.cut) {
                lines_of_cut_block<use>(p, rows, block.begin + lane, block.length, step, {scratch});
            } else {
                lines_of_block<use>(p, rows, block.begin + lane, block.length, step, {scratch});
            }
        }
    }
}

inline void lines_pass(const ParticleView& p, const RowView& rows, std::span<const LineBlock> blocks, float h,
                       LambdaUse use, float* scratch) {
    switch (use) {
        case LambdaUse::discard: return lines_of<LambdaUse::discard>(p, rows, blocks, h, scratch);
        case LambdaUse::store: return lines_of<LambdaUse::store>(p, rows, blocks, h, scratch);
        case LambdaUse::accumulate: return lines_of<LambdaUse::accumulate>(p, rows, blocks, h, scratch);
    }
}
