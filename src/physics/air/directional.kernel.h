// The same wind everywhere. n0 is its velocity [m/s]; n1 and n2 are unit vectors perpendicular to it.

WEFT_FN Flow flow_directional(vec3 p, WindNumbers n)
{
    Flow flow;
    flow.velocity = n.n0;
    flow.q1 = dot(p, n.n1);
    flow.q2 = dot(p, n.n2);
    return flow;
}
