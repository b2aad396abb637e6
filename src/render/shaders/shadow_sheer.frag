#version 460
// Of a sheer cloth, as many points cast a shadow as its threads cover.
#include "render/shaders/common.glsl"
#define object push.object.data

void main() {
    float covered = whole(object.material.data.velvet).z;
    if (pixel_noise(gl_FragCoord.xy, whole(frame.light).w) >= covered) discard;
}
