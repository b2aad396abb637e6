#version 460
// Shadow of sheer cloth: keeps a random share of the texels that equals the coverage of its threads.
#include "render/shaders/common.glsl"

void main() {
    float covered = whole(material.velvet).z;
    if (pixel_noise(gl_FragCoord.xy, whole(frame.light).w) >= covered) discard;
}
