// Solves lines of stretch constraints, one line per lane. Included by passes.inl.

struct LinePoint {
    vec3 place, remainder;  // the remainder only where it is kept
    real w;
};

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
    template <bool exact>
    WEFT_FN void keep_point(std::size_t row, const LinePoint& p) const {
        store(p.place.x, entry(row, 6)), store(p.place.y, entry(row, 7)), store(p.place.z, entry(row, 8));
        store(p.w, entry(row, 9));
        if (!exact) return;
        store(p.remainder.x, entry(row, 10)), store(p.remainder.y, entry(row, 11));
        store(p.remainder.z, entry(row, 12));
    }
    template <bool exact>
    WEFT_FN LinePoint point(std::size_t row) const {
        LinePoint p;
        p.place = vec3(load(entry(row, 6)), load(entry(row, 7)), load(entry(row, 8)));
        p.w = load(entry(row, 9));
        if (exact) p.remainder = vec3(load(entry(row, 10)), load(entry(row, 11)), load(entry(row, 12)));
        return p;
    }
};

template <bool exact>
WEFT_FN LinePoint gather_point(const ParticleView& p, const std::uint32_t* index) {
    LinePoint point;
    point.place = gather_blocks(p.position, index, point.w);
    real unused;
    if (exact) point.remainder = gather_blocks(p.remainder, index, unused);
    return point;
}

template <bool exact>
WEFT_FN void move_point(const ParticleView& p, const std::uint32_t* index, LinePoint point, vec3 by) {
    if (exact) {
        move_exactly(point.place, point.remainder, by);
        scatter_blocks(point.remainder, real(0.0f), p.remainder, index);
    } else {
        point.place = point.place + by;
    }
    scatter_blocks(point.place, point.w, p.position, index);
}

// The constraint at row r, between a and b.
template <LambdaUse use, bool exact>
WEFT_FN LineRow eliminate(LineRow& before, const LinePoint& a, const LinePoint& b, const RowView& rows, std::size_t r,
                          const Step& step) {
    const real lambda = use == LambdaUse::accumulate ? load(rows.lambda + r) : real(0.0f);
    const StretchRow row = StretchTraits::load_row(rows.fields + r, rows.stride);
    if (!exact) return eliminate_stretch(before, a.place, b.place, a.w, b.w, lambda, row, step);
    const vec3 from_a = (b.place - a.place) + (b.remainder - a.remainder);
    return eliminate_stretch(before, vec3(real(0.0f)), from_a, a.w, b.w, lambda, row, step);
}

// The change of a constraint's multiplier.
template <LambdaUse use>
WEFT_FN real substitute(const LineRow& row, real next, const RowView& rows, std::size_t r) {
    next = substitute_stretch(row, next);
    if (use == LambdaUse::store) store(next, rows.lambda + r);
    if (use == LambdaUse::accumulate) store(load(rows.lambda + r) + next, rows.lambda + r);
    return next;
}

template <LambdaUse use, bool exact>
inline void lines_of_block(const ParticleView& p, const RowView& rows, std::size_t begin, std::size_t length,
                           const Step& step, const LineScratch& scratch) {
    const std::uint32_t* second = rows.particles + rows.stride;
    LinePoint a = gather_point<exact>(p, rows.particles + begin);
    LineRow before = line_start();
    for (std::size_t k = 0; k < length; ++k) {
        const std::size_t r = begin + k * lane_padding;
        const LinePoint b = gather_point<exact>(p, second + r);
        const LineRow now = eliminate<use, exact>(before, a, b, rows, r, step);
        if (k > 0) scratch.keep_factor(k - 1, before.factor);
        scratch.keep_row(k, now);
        scratch.keep_point<exact>(k, a);
        before = now, a = b;
    }
    scratch.keep_factor(length - 1, real(0.0f));

    vec3 pull(real(0.0f));  // of the constraint processed before
    real next = real(0.0f);
    for (std::size_t k = length; k-- > 0;) {
        const std::size_t r = begin + k * lane_padding;
        const LineRow row = scratch.row(k);
        next = substitute<use>(row, next, rows, r);
        const vec3 mine = row.n * next;
        move_point<exact>(p, second + r, a, (pull - mine) * a.w);
        pull = mine;
        a = scratch.point<exact>(k);
    }
    move_point<exact>(p, rows.particles + begin, a, pull * a.w);
}

// Whether all lines go on from the constraint before row `r` to that at row `r`.
WEFT_FN bool all_go_on(const std::uint32_t* first, const std::uint32_t* second, std::size_t r) {
    constexpr std::uint32_t all = (std::uint32_t{2} << (lane_count - 1)) - 1;
    return bits_of(same_index(first + r, second + r - lane_padding)) == all;
}

// The same for a block in which lines end: a constraint may begin at another particle than that at which the one before
// it ends. Few do, so where all lines go on, particles are read and written once, as above. Gives the bits of
// lines_of_block() where the particles are the same.
template <LambdaUse use, bool exact>
inline void lines_of_cut_block(const ParticleView& p, const RowView& rows, std::size_t begin, std::size_t length,
                               const Step& step, const LineScratch& scratch) {
    const std::uint32_t *first = rows.particles, *second = rows.particles + rows.stride;
    LineRow before = line_start();
    LinePoint a = gather_point<exact>(p, first + begin);
    for (std::size_t k = 0; k < length; ++k) {
        const std::size_t r = begin + k * lane_padding;
        if (k > 0 && !all_go_on(first, second, r)) {
            a = gather_point<exact>(p, first + r);
            before.n = select(same_index(first + r, second + r - lane_padding), before.n, vec3(real(0.0f)));
        }
        const LinePoint b = gather_point<exact>(p, second + r);
        const LineRow now = eliminate<use, exact>(before, a, b, rows, r, step);
        if (k > 0) scratch.keep_factor(k - 1, before.factor);
        scratch.keep_row(k, now);
        scratch.keep_point<exact>(k, a);
        before = now, a = b;
    }
    scratch.keep_factor(length - 1, real(0.0f));

    vec3 pull(real(0.0f));  // of the constraint processed before
    real next = real(0.0f);
    for (std::size_t k = length; k-- > 0;) {
        const std::size_t r = begin + k * lane_padding, after = r + lane_padding;
        const LineRow row = scratch.row(k);
        next = substitute<use>(row, next, rows, r);
        const vec3 mine = row.n * next;
        if (k + 1 == length || all_go_on(first, second, after)) {
            move_point<exact>(p, second + r, a, (pull - mine) * a.w);
        } else {
            const LinePoint end = gather_point<exact>(p, second + r);  // no constraint has moved it yet
            move_point<exact>(p, first + after, a, pull * a.w);
            const mask goes_on = same_index(first + after, second + r);
            move_point<exact>(p, second + r, end, (select(goes_on, pull, vec3(real(0.0f))) - mine) * end.w);
        }
        pull = mine;
        a = scratch.point<exact>(k);
    }
    move_point<exact>(p, first + begin, a, pull * a.w);
}

template <LambdaUse use, bool exact>
inline void lines_of(const ParticleView& p, const RowView& rows, std::span<const LineBlock> blocks, float h,
                     float* scratch) {
    const Step step = make_step(h);
    for (const LineBlock& block : blocks) {
        for (std::size_t lane = 0; lane < lane_padding; lane += lane_count) {
            if (block.cut) {
                lines_of_cut_block<use, exact>(p, rows, block.begin + lane, block.length, step, {scratch});
            } else {
                lines_of_block<use, exact>(p, rows, block.begin + lane, block.length, step, {scratch});
            }
        }
    }
}

template <LambdaUse use>
inline void lines_of(const ParticleView& p, const RowView& rows, std::span<const LineBlock> blocks, float h,
                     float* scratch) {
    return p.remainder ? lines_of<use, true>(p, rows, blocks, h, scratch)
                       : lines_of<use, false>(p, rows, blocks, h, scratch);
}

inline void lines_pass(const ParticleView& p, const RowView& rows, std::span<const LineBlock> blocks, float h,
                       LambdaUse use, float* scratch) {
    switch (use) {
        case LambdaUse::discard: return lines_of<LambdaUse::discard>(p, rows, blocks, h, scratch);
        case LambdaUse::store: return lines_of<LambdaUse::store>(p, rows, blocks, h, scratch);
        case LambdaUse::accumulate: return lines_of<LambdaUse::accumulate>(p, rows, blocks, h, scratch);
    }
}
