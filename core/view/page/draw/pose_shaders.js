/** GLSL: the pose of a body between two frames, for the vertices of bodies, of their shade and of what they carry. */
export const POSE = `
uniform sampler2D poses;   // four texels a body: previous place and turn, next place and turn; fourth of a place: the height of the floor, m
uniform vec2 size;         // of the texture
uniform float share;
vec4 texel(float index) {
    float row = floor((index + 0.5) / size.x);
    return texture2D(poses, vec2(index - row * size.x + 0.5, row + 0.5) / size);
}
vec3 turned(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
/* Returns where the body of a row is, m, and its turn, a quaternion, in \`q\`. */
vec3 poseOf(float row, out vec4 q) {
    float first = 4.0 * row;
    vec4 q0 = texel(first + 1.0), q1 = texel(first + 3.0);
    q = mix(dot(q0, q1) < 0.0 ? -q0 : q0, q1, share);
    q = dot(q, q) < 1e-6 ? vec4(0.0, 0.0, 0.0, 1.0) : normalize(q);
    return mix(texel(first).xyz, texel(first + 2.0).xyz, share);
}
float floorUnder(float row) { return mix(texel(4.0 * row).w, texel(4.0 * row + 2.0).w, share); }
`;
