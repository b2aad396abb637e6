// Reads vertices from buffers by index.

vec3 to_world(vec3 p) {
    return object.transform[0].xyz * p.x + object.transform[1].xyz * p.y + object.transform[2].xyz * p.z +
           object.transform[3].xyz;
}
vec3 turned(vec3 d) { return object.transform[0].xyz * d.x + object.transform[1].xyz * d.y + object.transform[2].xyz * d.z; }
vec3 world_position() { return to_world(object.positions.at[gl_VertexIndex].xyz); }
