// The load of a particle (law: tear.md).
struct TearLoad {
    real load;   // tension over the limit, or strain over its limit
    real x, y;   // direction of the tension, in the axes of the vertex
    bool end;    // a cut ends here
    bool seam;   // across a seam, which opens before the fabric does
};
