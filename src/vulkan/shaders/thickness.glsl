// How thick the cloth is at its places.
#ifndef WEFT_THICKNESS_GLSL
#define WEFT_THICKNESS_GLSL

// m: half of the thickness at a particle.
float half_thickness_at(FrameRef frame, uint p)
{
    float half_of_fabric = frame.at.half_thickness;
    return is_none(uvec2(frame.at.thickness)) ? half_of_fabric : half_of_fabric * frame.at.thickness.at[p];
}
// Likewise where a face is thinnest.
float half_thickness_of_face(FrameRef frame, uvec3 corner)
{
    float half_of_fabric = frame.at.half_thickness;
    if (is_none(uvec2(frame.at.thickness))) return half_of_fabric;
    float a = frame.at.thickness.at[corner.x], b = frame.at.thickness.at[corner.y], c = frame.at.thickness.at[corner.z];
    return half_of_fabric * min(a, min(b, c));
}

#endif
