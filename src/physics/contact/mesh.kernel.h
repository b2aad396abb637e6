// Solid bounded by triangles: a signed distance field, which src/collide/distance_field.h builds.
//   numbers  all unused
//   data     block 0: origin of the grid x, y, z [m], cells per meter
//            block 1: number of places along x, y, z, size of a cell [m]
//            block 2: number of the table's first word, number of the first coarse block, units of the corners of fine
//                     and of coarse blocks [cells]
//            table:   a float per place: the number of the first block of its brick, 0 if it has none
//            coarse:  a block per place: the distances at its corners
//            bricks:  512 blocks each, one per cell: the distances at its corners
//
// A place is a cube of 8 x 8 x 8 cells. Places near the surface have a brick. Places and the cells of a brick are ordered
// with x fastest, z slowest. A block has eight signed integers of 16 bits; corner x + 2 y + 4 z.

WEFT_FN real clamp_from_zero(real x, real high) { return min(max(x, real(0)), high); }
WEFT_FN vec3 floor_of(vec3 v) { return vec3(floor(v.x), floor(v.y), floor(v.z)); }

WEFT_FN real distance_mesh(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    real cells_per_meter, cell_size, coarse_unit;
    vec3 origin = block_of(s.data, 0, cells_per_meter);
    vec3 places = block_of(s.data, 1, cell_size);
    vec3 parts = block_of(s.data, 2, coarse_unit);   // table, first coarse block, unit of fine blocks

    // From here on in cells. Points beyond the grid take the value at the nearest point of the grid and the distance to it
    // as the legs of a right triangle: the surface, which is in the grid, is at least as far as its long side. The grid
    // ends a thousandth of a cell early, so that rounding down gives valid numbers at its end too.
    vec3 q = (p - origin) * cells_per_meter;
    vec3 end = places * real(7.99999);
    vec3 at = vec3(clamp_from_zero(q.x, end.x), clamp_from_zero(q.y, end.y), clamp_from_zero(q.z, end.z));
    vec3 beyond = q - at;

    vec3 place = floor_of(at * real(0.125));
    real number = place.x + places.x * (place.y + places.y * place.z);
    real brick = number_of(s.data, parts.x + number);
    mask fine = brick > real(0);

    vec3 local = at - place * real(8);
    vec3 cell = floor_of(local);
    real block = select(fine, brick + (cell.x + real(8) * cell.y + real(64) * cell.z), parts.y + number);
    vec3 f = select(fine, local - cell, local * real(0.125));
    Shorts c = shorts_of(s.data, block);

    // Trilinear: along x, then y, then z. Differences along an axis, interpolated along the others, are the gradient.
    real dx0 = c.s1 - c.s0, dx1 = c.s3 - c.s2, dx2 = c.s5 - c.s4, dx3 = c.s7 - c.s6;
    real x0 = c.s0 + dx0 * f.x, x1 = c.s2 + dx1 * f.x, x2 = c.s4 + dx2 * f.x, x3 = c.s6 + dx3 * f.x;
    real dy0 = x1 - x0, dy1 = x3 - x2;
    real y0 = x0 + dy0 * f.y, y1 = x2 + dy1 * f.y;
    real dz = y1 - y0;
    real gx0 = dx0 + (dx1 - dx0) * f.y, gx1 = dx2 + (dx3 - dx2) * f.y;
    vec3 g = vec3(gx0 + (gx1 - gx0) * f.z, dy0 + (dy1 - dy0) * f.z, dz);
    real unit = select(fine, parts.z, coarse_unit);
    real value = (y0 + dz * f.z) * unit;
    g = g * (unit * select(fine, real(1), real(0.125)));

    real len2 = dot(beyond, beyond);
    mask outside = len2 > real(0);
    real leg = max(value, real(0));
    real far = sqrt(leg * leg + len2);
    real share = select(outside, leg * (real(1) / max(far, real(1e-20))), real(1));
    vec3 away = beyond * (real(1) / max(far, real(1e-20)));
    g = vec3(select(abs(beyond.x) > real(0), away.x, g.x * share), select(abs(beyond.y) > real(0), away.y, g.y * share),
             select(abs(beyond.z) > real(0), away.z, g.z * share));

    // Where opposite sides are equally far the gradient may be zero: use y.
    real g2 = dot(g, g);
    mask sloped = g2 > real(1e-8);
    normal = select(sloped, g * (real(1) / sqrt(max(g2, real(1e-8)))), vec3(real(0), real(1), real(0)));
    return select(outside, far, value + len2) * cell_size;
}
