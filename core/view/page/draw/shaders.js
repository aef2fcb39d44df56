// Shaders. People: a slot's record is decoded on the graphics card from the
// bytes as they came, and people slide from the previous frame to the next one.

/** Records of two frames, A and B; `swapped` says that A is the newer one. */
export const RECORDS = `
precision highp float;
attribute vec4 position;   // frame A: x low, x high, y low, y high
attribute vec4 infoA;      // heading, state, value, flags
attribute vec4 placeB;
attribute vec4 infoB;
attribute vec4 person;     // radius in cm, group, breadth and depth of the torso in cm (0: a disc)
attribute float chestA, chestB; // where the chest points, 256ths of a turn
attribute float look;      // 0 to 255: how this one differs from others
uniform vec4 mapA, mapB;   // x0, y0, sx, sy, in m
uniform float share, swapped;
uniform float passed;      // s between the frames
uniform float classes;     // 0: by value, 1: by state, 2: by group, 3: whether the program failed, 4: by heading
uniform mat4 viewMatrix, projectionMatrix;
const float TURN = 6.28318530718;

// half_axis: half of the length of the torso's axis, m, 0 of a disc; surface: its distance from the axis, m
struct Person { vec2 at; vec2 ahead; vec2 chest; vec2 lean; float radius; float half_axis; float surface; float colour; float flags; float speed; bool here; bool lies; };

vec2 place(vec4 b, vec4 map) { return map.xy + map.zw * vec2(b.x + 256.0 * b.y, b.z + 256.0 * b.w); }

// Lean of a person under pushes: rad, in the direction of the push.
vec2 leanOf(float flags) {
    float code = floor(flags / 8.0), way = mod(code - 1.0, 8.0) * TURN / 8.0;
    return code < 0.5 || code > 24.5 ? vec2(0.0) : (0.1 + 0.12 * floor((code - 1.0) / 8.0)) * vec2(cos(way), sin(way));
}

// Angle on the shorter way between two, of 256ths of a turn; rad.
float turned(float from, float to, float t) {
    return (from + t * (mod(to - from + 384.0, 256.0) - 128.0)) * TURN / 256.0;
}

Person decode() {
    bool late = swapped > 0.5;
    vec4 oldInfo = late ? infoB : infoA, info = late ? infoA : infoB;
    vec2 before = late ? place(placeB, mapB) : place(position, mapA);
    vec2 after = late ? place(position, mapA) : place(placeB, mapB);
    float t = share;
    // A slot that was empty or has another person now does not slide.
    bool another = oldInfo.y > 254.5 || mod(oldInfo.w, 2.0) != mod(info.w, 2.0);
    if (another) t = 1.0;
    float turn = turned(oldInfo.x, info.x, t);
    Person p;
    p.at = mix(before, after, t);
    p.ahead = vec2(cos(turn), sin(turn));
    p.radius = (person.x < 0.5 ? 20.0 : max(person.x, 5.0)) / 100.0; // 0: not told yet
    bool isLong = person.z > person.w + 0.5;
    p.half_axis = isLong ? (person.z - person.w) / 200.0 : 0.0;
    p.surface = isLong ? person.w / 200.0 : p.radius;
    float breast = turned(late ? chestB : chestA, late ? chestA : chestB, t);
    p.chest = isLong ? vec2(cos(breast), sin(breast)) : p.ahead;
    float failed = mod(floor(info.w / 2.0), 2.0);
    p.colour = ((classes < 0.5 ? info.z : classes < 1.5 ? info.y : classes < 2.5 ? person.y
        : classes < 3.5 ? 4.0 - failed : floor(256.0 * fract(turn / TURN + 1.0))) + 0.5) / 256.0;
    p.flags = info.w;
    p.lean = mix(leanOf(oldInfo.w), leanOf(info.w), t);
    p.speed = another ? 0.0 : min(length(after - before) / passed, 8.0);
    p.here = info.y < 254.5;
    p.lies = floor(info.w / 8.0) > 30.5;
    return p;
}
`;

/** How individuals differ: their clothes' lightness, where colours are classes, and their skin and hair. */
const LOOKS = `
vec3 clothes(vec3 colour, float look, float classes) {
    return colour * (classes > 0.5 ? 0.84 + 0.3 * look : 0.96 + 0.08 * look);
}
vec3 skin(float look) {
    float k = fract(look * 7.3);
    return k < 0.5 ? mix(vec3(0.36, 0.23, 0.16), vec3(0.66, 0.46, 0.33), 2.0 * k) : mix(vec3(0.66, 0.46, 0.33), vec3(0.93, 0.76, 0.62), 2.0 * k - 1.0);
}
vec3 hair(float look) { return mix(vec3(0.07, 0.06, 0.06), vec3(0.34, 0.24, 0.17), pow(fract(look * 13.7), 2.0)); }
`;

/** Everyone as one point: a disc from above, an upright capsule from the side. */
export const POINT_VERTEX = RECORDS + `
uniform float pixels;      // pixels per metre at distance 1 (orthographic: per metre)
uniform float tall;        // visible share of a height: cosine of the camera's elevation
uniform float nearer;      // m: people nearer to the camera are drawn as figures
uniform vec3 eye;
varying vec4 paint;        // radius and half of the spine in pixels, colour, flags
varying vec4 nose;         // where it looks on the screen, its look, and the radius of its head in pixels
varying vec2 across;       // from the middle to the left end of the torso's axis, or to the head of one who lies, in pixels
const float HEIGHT = 1.7;
void main() {
    Person p = decode();
    float high = p.lies ? 0.3 : HEIGHT;
    vec3 middle = vec3(p.at, 0.5 * high);
    gl_Position = projectionMatrix * viewMatrix * vec4(middle, 1.0);
    float metre = pixels / gl_Position.w;
    float r = max(p.surface * metre, 0.6);
    float spine = max(0.0, 0.5 * high * tall * metre - r);
    paint = vec4(r, spine, p.colour, p.flags);
    vec2 seen = (viewMatrix * vec4(p.ahead, 0.0, 0.0)).xy;
    nose = vec4(seen.x, -seen.y, look / 255.0, 0.5 * r + 0.25 * p.half_axis * metre);
    vec2 axis = p.lies ? (0.5 * HEIGHT - p.surface) * p.ahead : p.half_axis * vec2(-p.chest.y, p.chest.x);
    across = metre * vec2(1.0, -1.0) * (viewMatrix * vec4(axis, 0.0, 0.0)).xy;
    gl_PointSize = 2.0 * (r + spine + length(across));
    if (!p.here || distance(middle, eye) < nearer) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

export const POINT_FRAGMENT = `
precision highp float;
uniform sampler2D colours;
uniform float tall, classes;
varying vec4 paint, nose;
varying vec2 across;
` + LOOKS + `
void main() {
    float r = paint.x, spine = paint.y;
    vec3 colour = clothes(texture2D(colours, vec2(paint.z, 0.5)).rgb, nose.z, classes);
    if (r > 1.2) {
        // A body, and over it a head; from above the head is in the middle of the shoulders.
        vec2 at = (gl_PointCoord - 0.5) * 2.0 * (r + spine + length(across));
        float shoulder = max(0.0, spine - 0.8 * r);
        vec2 side = at - across * clamp(dot(at, across) / max(dot(across, across), 1e-6), -1.0, 1.0);
        float body = length(vec2(side.x, side.y - clamp(side.y, -shoulder, spine))) / r;
        vec2 middle = floor(paint.w / 8.0) > 30.5 ? across : vec2(0.0, -(spine + 0.4 * r * tall)); // lies
        float head = distance(at, middle) / nose.w;
        if (body > 1.0 && head > 1.0) discard;
        vec3 top = hair(nose.z);
        bool seen = tall < 0.4 || nose.y > 0.0;
        if (seen && distance(at, middle + nose.xy * 0.6 * nose.w) < 0.72 * nose.w) top = skin(nose.z);
        float d = min(head < 1.0 ? head : body, 1.0);
        colour = head < 1.0 ? mix(colour, top, 0.85) : colour * (0.78 + 0.22 * smoothstep(spine, -shoulder, at.y));
        colour *= 1.02 - 0.26 * d * d;
        if (mod(floor(paint.w / 4.0), 2.0) > 0.5 && head >= 1.0 && body > 0.75) colour = vec3(1.0);
    }
    gl_FragColor = vec4(colour, 1.0);
}`;

/** The shade that people cast around their feet. */
export const SHADE_VERTEX = RECORDS + `
uniform float pixels;
varying float dark;
void main() {
    Person p = decode();
    gl_Position = projectionMatrix * viewMatrix * vec4(p.at, 0.01, 1.0);
    float r = 1.7 * p.radius * pixels / gl_Position.w;
    gl_PointSize = 2.0 * r;
    dark = 0.42 * smoothstep(1.5, 5.0, r);
    if (!p.here || r < 1.5) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

export const SHADE_FRAGMENT = `
precision highp float;
uniform float tall;        // as for points; sqrt(1 - tall^2) flattens discs on the floor
varying float dark;
void main() {
    vec2 at = (gl_PointCoord - 0.5) * 2.0;
    float d = length(vec2(at.x, at.y / max(0.12, sqrt(1.0 - tall * tall))));
    if (d > 1.0) discard;
    gl_FragColor = vec4(0.05, 0.06, 0.09, dark * (1.0 - d) * (1.0 - 0.3 * d));
}`;

/** Those near the eye as figures that look where they go, and step the faster the faster they go. */
export const FIGURE_VERTEX = RECORDS + `
attribute vec3 corner;     // of a figure 1 m high and 1 m wide, looking along +x
attribute vec3 normal;
attribute vec3 swing;      // of a limb: direction and height of its swing; and its part
uniform float clock;       // s
varying vec3 facing, where;
varying float shade, marks, self, limb;
const float CADENCE = 0.95; // strides of two steps a second
void main() {
    Person p = decode();
    float own = look / 255.0;
    float high = 1.7 * clamp(sqrt(p.radius / 0.2), 0.6, 1.15) * (0.95 + 0.1 * fract(own * 5.1));
    // The body of the figure is 0.48 deep where it is 1 wide.
    bool broad = p.half_axis > 0.0;
    vec3 scale = vec3(broad ? p.surface / 0.24 : 2.0 * p.radius, broad ? 2.0 * (p.half_axis + p.surface) : 2.0 * p.radius, high);
    vec3 c = corner * scale, n = normal / scale;
    float wide = p.lies ? 0.0 : min(0.5, 0.34 * p.speed) * smoothstep(0.05, 0.3, p.speed);
    float turn = wide * swing.x * sin(TURN * (CADENCE * (0.9 + 0.2 * own) * clock * max(1.0, 0.75 * p.speed) + own));
    if (swing.x != 0.0) {
        float down = swing.y * high - c.z;
        c.x += down * sin(turn);
        c.z += down * (1.0 - cos(turn));
    }
    vec2 runs = p.chest * 0.05 * min(p.speed, 3.0) * c.z * c.z / high; // runners lean forward
    vec2 ahead = swing.z > 2.5 ? p.ahead : p.chest, left = vec2(-ahead.y, ahead.x); // heads look, bodies turn
    vec3 at = vec3(p.at + ahead * c.x + left * c.y + runs + p.lean * c.z, c.z * (1.0 - 0.5 * dot(p.lean, p.lean)));
    facing = normalize(vec3(ahead * n.x + left * n.y, n.z));
    if (p.lies) { // on the back, the head ahead
        at = vec3(p.at + ahead * (c.z - 0.5 * high) - left * c.y, 0.14 + c.x);
        facing = normalize(vec3(ahead * n.z - left * n.y, n.x));
    }
    where = corner;
    shade = p.colour;
    marks = p.flags;
    self = own;
    limb = swing.z;
    gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
    if (!p.here) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

export const FIGURE_FRAGMENT = `
precision highp float;
uniform sampler2D colours;
uniform float classes;
varying vec3 facing, where;
varying float shade, marks, self, limb;
` + LOOKS + `
void main() {
    vec3 own = clothes(texture2D(colours, vec2(shade, 0.5)).rgb, self, classes), colour = own;
    bool head = limb > 2.5, leg = limb > 0.5 && limb < 1.5, arm = limb > 1.5 && limb < 2.5;
    if (head) colour = where.z > 0.955 || where.x < -0.05 ? hair(self) : skin(self);
    if (arm && where.z < 0.47) colour = skin(self);
    if (leg) colour = where.z < 0.045 ? vec3(0.12) : mix(own * 0.62, vec3(0.2, 0.21, 0.25), 0.3);
    if (mod(floor(marks / 4.0), 2.0) > 0.5 && leg) colour = vec3(1.0);
    vec3 n = normalize(facing);
    float light = 0.66 + 0.2 * n.z + 0.32 * max(0.0, dot(n, vec3(0.45, -0.55, 0.7)));
    gl_FragColor = vec4(colour * min(light, 1.14) * (0.72 + 0.28 * smoothstep(0.0, 0.55, where.z)), 1.0);
}`;
