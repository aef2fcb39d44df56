/* Makes Bullet's shape, its parts and its mass properties from a definition. The integrals over
   a hull are computed here, as Bullet takes the inertia of its bounding box. */
#include "body/bullet.h"

#include <string.h>

#include <LinearMath/btConvexHullComputer.h>

extern "C" {
#include "base/number/elementary.h"
#include "base/number/pi.h"
}

namespace {

const double MOST_SIZE = 1000.0, LEAST_SIZE = 0.001, MOST_MASS = 1e9;
const double LEAST_MASS = 1e-9; /* kg: the inverse moments of a lighter body overflow a float */
enum { PRISM_SIDES = 16 };

/* Volume and moments of one part of unit density in its own frame. */
struct Solid {
    double volume;
    double centre[3];
    double second[3][3]; /* integral of x_i x_j dV about the centre */
};

bool refuse_shape(JoxText *error, const char *text) {
    if (error)
        jox_text_add(error, text);
    return false;
}

bool is_in_range(double value, double low, double high) {
    return std::isfinite(value) && value >= low && value <= high;
}

bool make_unit_quaternion(const double turn[4], btQuaternion *out) {
    double n = 0;
    for (int i = 0; i < 4; i++) {
        if (!is_in_range(turn[i], -1e6, 1e6))
            return false;
        n += turn[i] * turn[i];
    }
    if (n == 0) {
        *out = btQuaternion(0, 0, 0, 1);
        return true;
    }
    if (n < 1e-12)
        return false;
    double s = 1 / sqrt(n);
    *out = btQuaternion(float(turn[0] * s), float(turn[1] * s), float(turn[2] * s),
                        float(turn[3] * s));
    return true;
}

void allocate_corners(JoxConvexPart *part, uint32_t corners, uint32_t edges) {
    part->corners = static_cast<JoxV3 *>(jox_alloc(corners, sizeof(JoxV3)));
    part->edges = static_cast<uint32_t *>(jox_alloc(edges, 2 * sizeof(uint32_t)));
    part->corner_count = corners;
    part->edge_count = edges;
}

btCollisionShape *make_box_part(const JoxShape *shape, JoxConvexPart *part, Solid *solid) {
    double a = shape->size[0], b = shape->size[1], c = shape->size[2];
    btVector3 half(float(a / 2), float(b / 2), float(c / 2));
    allocate_corners(part, 8, 12);
    uint32_t e = 0;
    for (uint32_t i = 0; i < 8; i++) {
        part->corners[i] = JoxV3{i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                 i & 4 ? half.z() : -half.z()};
        for (uint32_t bit = 1; bit < 8; bit <<= 1)
            if (!(i & bit)) {
                part->edges[e++] = i;
                part->edges[e++] = i | bit;
            }
    }
    solid->volume = a * b * c;
    solid->second[0][0] = solid->volume * a * a / 12;
    solid->second[1][1] = solid->volume * b * b / 12;
    solid->second[2][2] = solid->volume * c * c / 12;
    return new btBoxShape(half);
}

btCollisionShape *make_sphere_part(const JoxShape *shape, JoxConvexPart *part, Solid *solid) {
    double r = shape->size[0];
    part->radius = float(r);
    solid->volume = 4.0 / 3.0 * JOX_PI * r * r * r;
    for (int i = 0; i < 3; i++)
        solid->second[i][i] = solid->volume * r * r / 5;
    return new btSphereShape(float(r));
}

btCollisionShape *make_cylinder_part(const JoxShape *shape, JoxConvexPart *part, Solid *solid) {
    double r = shape->size[0], h = shape->size[1];
    part->radius = float(r);
    allocate_corners(part, 2 * PRISM_SIDES, 3 * PRISM_SIDES);
    for (uint32_t i = 0; i < PRISM_SIDES; i++) {
        double angle = i * (JOX_TURN / PRISM_SIDES);
        float x = float(r * jox_cos(angle)), y = float(r * jox_sin(angle));
        part->corners[i] = JoxV3{x, y, float(-h / 2)};
        part->corners[i + PRISM_SIDES] = JoxV3{x, y, float(h / 2)};
        uint32_t next = (i + 1) % PRISM_SIDES;
        uint32_t edges[6] = {i, next, i + PRISM_SIDES, next + PRISM_SIDES, i, i + PRISM_SIDES};
        for (uint32_t k = 0; k < 6; k++)
            part->edges[6 * i + k] = edges[k];
    }
    solid->volume = JOX_PI * r * r * h;
    solid->second[0][0] = solid->second[1][1] = solid->volume * r * r / 4;
    solid->second[2][2] = solid->volume * h * h / 12;
    return new btCylinderShapeZ(btVector3(float(r), float(r), float(h / 2)));
}

/* Adds the tetrahedron origin-a-b-c: for it, the integral of x_i x_j is V/20 (sum over the four
   corners of p_i p_j + S_i S_j), with S the sum of the corners. */
void add_tetrahedron(Solid *s, const btVector3 &a, const btVector3 &b, const btVector3 &c) {
    double p[3][3] = {{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}, {c.x(), c.y(), c.z()}};
    double v = (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
                p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
               6;
    s->volume += v;
    double sum[3];
    for (int i = 0; i < 3; i++) {
        sum[i] = p[0][i] + p[1][i] + p[2][i];
        s->centre[i] += v * sum[i] / 4;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            s->second[i][j] +=
                v / 20 *
                (p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j] + sum[i] * sum[j]);
}

void integrate_hull(const btConvexHullComputer &hull, Solid *solid) {
    for (int f = 0; f < hull.faces.size(); f++) {
        const btConvexHullComputer::Edge *first = &hull.edges[hull.faces[f]];
        const btConvexHullComputer::Edge *e = first->getNextEdgeOfFace();
        btVector3 a = hull.vertices[first->getSourceVertex()];
        for (; e->getTargetVertex() != first->getSourceVertex(); e = e->getNextEdgeOfFace())
            add_tetrahedron(solid, a, hull.vertices[e->getSourceVertex()],
                            hull.vertices[e->getTargetVertex()]);
    }
    if (solid->volume < 0) {
        solid->volume = -solid->volume;
        for (int i = 0; i < 3; i++) {
            solid->centre[i] = -solid->centre[i];
            for (int j = 0; j < 3; j++)
                solid->second[i][j] = -solid->second[i][j];
        }
    }
    if (solid->volume <= 0)
        return;
    for (int i = 0; i < 3; i++)
        solid->centre[i] /= solid->volume;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            solid->second[i][j] -= solid->volume * solid->centre[i] * solid->centre[j];
}

/* Makes a convex hull; NULL if the points span no volume. */
btCollisionShape *make_hull_part(const JoxShape *shape, JoxConvexPart *part, Solid *solid) {
    btConvexHullComputer hull;
    hull.compute(shape->points, 3 * sizeof(double), int(shape->point_count), 0, 0);
    if (hull.vertices.size() < 4)
        return nullptr;
    integrate_hull(hull, solid);
    if (!(solid->volume > 1e-9))
        return nullptr;
    JOX_ASSERT(hull.edges.size() % 2 == 0); /* each edge is listed in both directions */
    uint32_t edges = 0;
    allocate_corners(part, uint32_t(hull.vertices.size()), uint32_t(hull.edges.size()) / 2 + 1);
    for (int i = 0; i < hull.vertices.size(); i++)
        part->corners[i] = jox_v3(hull.vertices[i]);
    for (int i = 0; i < hull.edges.size(); i++) {
        uint32_t a = uint32_t(hull.edges[i].getSourceVertex());
        uint32_t b = uint32_t(hull.edges[i].getTargetVertex());
        if (a < b && edges < part->edge_count) {
            part->edges[2 * edges] = a;
            part->edges[2 * edges + 1] = b;
            edges++;
        }
    }
    part->edge_count = edges;
    btConvexHullShape *made = new btConvexHullShape();
    made->setMargin(0.002f); /* before recalcLocalAabb, whose box includes the margin */
    for (int i = 0; i < hull.vertices.size(); i++)
        made->addPoint(hull.vertices[i], false);
    made->recalcLocalAabb();
    return made;
}

bool check_shape_sizes(const JoxShape *shape, JoxText *error) {
    static const int sizes[] = {3, 1, 2, 0, 0, 3};
    if (int(shape->kind) < 0 || shape->kind > JOX_SHAPE_BLOCKS)
        return refuse_shape(error,
                            "a body's shape is a box, sphere, cylinder, hull, compound or blocks");
    for (int i = 0; i < sizes[shape->kind]; i++)
        if (!is_in_range(shape->size[i], LEAST_SIZE, MOST_SIZE))
            return refuse_shape(error, "a body's sizes must lie between 0.001 and 1000 m");
    if (shape->kind != JOX_SHAPE_HULL)
        return true;
    if (!shape->points || shape->point_count < 4 || shape->point_count > 256)
        return refuse_shape(error, "a hull needs 4 to 256 points");
    for (uint32_t i = 0; i < 3 * shape->point_count; i++)
        if (!is_in_range(shape->points[i], -MOST_SIZE, MOST_SIZE))
            return refuse_shape(error, "a hull's points must lie within 1000 m");
    return true;
}

btCollisionShape *make_part(const JoxShape *shape, JoxConvexPart *part, Solid *solid,
                            JoxText *error) {
    if (!check_shape_sizes(shape, error))
        return nullptr;
    part->kind = shape->kind;
    switch (shape->kind) {
    case JOX_SHAPE_BOX:
        return make_box_part(shape, part, solid);
    case JOX_SHAPE_SPHERE:
        return make_sphere_part(shape, part, solid);
    case JOX_SHAPE_CYLINDER:
        return make_cylinder_part(shape, part, solid);
    case JOX_SHAPE_HULL: {
        btCollisionShape *made = make_hull_part(shape, part, solid);
        if (!made)
            refuse_shape(error, "the points of a hull must span a volume");
        return made;
    }
    default:
        refuse_shape(error, "a compound cannot hold a compound or bonded blocks");
        return nullptr;
    }
}

/* Computes a part's mass, kg; false with a sentence in `error` if it is not valid. */
bool compute_part_mass(double mass, double density, double volume, double *out, JoxText *error) {
    if (!is_in_range(mass, 0, MOST_MASS))
        return refuse_shape(error, "a body's mass must lie between 0 and 1e9 kg");
    if (!is_in_range(density, 0, 1e6))
        return refuse_shape(error, "a body's density must lie between 0 and 1e6 kg/m3");
    *out = mass > 0 ? mass : density * volume;
    if (!is_in_range(*out, 0, MOST_MASS))
        return refuse_shape(error, "a body's mass must lie between 0 and 1e9 kg");
    if (*out > 0 && *out < LEAST_MASS)
        return refuse_shape(error, "a body's mass is 0, or 1e-9 kg and more");
    return true;
}

/* Sums over all parts of mass, first and second moments, in the shape's own frame. */
struct Total {
    double mass, first[3], second[3][3];
};

void add_part_moments(Total *total, const Solid &solid, const btTransform &frame, double mass) {
    JOX_ASSERT(solid.volume > 0 && mass > 0);
    double scale = mass / solid.volume, at[3];
    const btMatrix3x3 &r = frame.getBasis();
    for (int i = 0; i < 3; i++)
        at[i] = double(frame.getOrigin()[i]) + r[i][0] * solid.centre[0] +
                r[i][1] * solid.centre[1] + r[i][2] * solid.centre[2];
    total->mass += mass;
    for (int i = 0; i < 3; i++) {
        total->first[i] += mass * at[i];
        for (int j = 0; j < 3; j++) {
            double sum = mass * at[i] * at[j];
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum += scale * r[i][k] * solid.second[k][l] * r[j][l];
            total->second[i][j] += sum;
        }
    }
}

/* Computes centre of mass, principal axes and moments. */
void compute_principal_axes(const Total &total, JoxBodyShape *out) {
    double c[3], s[3][3], trace = 0, off = 0;
    for (int i = 0; i < 3; i++)
        c[i] = total.first[i] / total.mass;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            s[i][j] = total.second[i][j] - total.mass * c[i] * c[j];
        trace += s[i][i];
    }
    btMatrix3x3 axes = btMatrix3x3::getIdentity(), tensor;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            tensor[i][j] = float((i == j ? trace : 0) - s[i][j]);
            if (i != j)
                off += fabs(s[i][j]);
        }
    /* Keep the axes of a body that is symmetric about them. */
    if (off > 1e-6 * trace)
        tensor.diagonalize(axes, 1e-6f, 40);
    out->inertia = btVector3(tensor[0][0], tensor[1][1], tensor[2][2]);
    out->frame = btTransform(axes, btVector3(float(c[0]), float(c[1]), float(c[2])));
    out->mass = float(total.mass);
}

/* Whether the moments are those of a solid. For a needle rounding loses the smallest one beside
   the others. */
bool are_moments_valid(const btVector3 &inertia) {
    bool good = true;
    for (int i = 0; i < 3; i++)
        good = good && inertia[i] > 0 &&
               inertia[i] <= 1.001f * (inertia[(i + 1) % 3] + inertia[(i + 2) % 3]);
    return good;
}

/* Transforms the parts into the frame of centre of mass and principal axes, and computes the
   bounding radius and smallest half extent. */
void transform_parts(JoxBodyShape *out) {
    btTransform back = out->frame.inverse();
    out->bound = 0;
    out->inner = INFINITY;
    for (uint32_t p = 0; p < out->part_count; p++) {
        JoxConvexPart *part = &out->parts[p];
        part->frame = back * part->frame;
        btVector3 low, high;
        out->children[p]->getAabb(btTransform::getIdentity(), low, high);
        btVector3 half = (high - low) * 0.5f;
        float least = half[half.minAxis()];
        if (part->kind == JOX_SHAPE_HULL) /* the box of a hull includes the margin twice */
            least -= 2 * out->children[p]->getMargin();
        out->inner = least < out->inner ? least : out->inner;
        for (uint32_t i = 0; i < part->corner_count; i++) {
            btVector3 at = part->frame * jox_bt(part->corners[i]);
            part->corners[i] = jox_v3(at);
            float reach = at.length();
            out->bound = reach > out->bound ? reach : out->bound;
        }
        if (part->kind == JOX_SHAPE_SPHERE) {
            float reach = part->frame.getOrigin().length() + part->radius;
            out->bound = reach > out->bound ? reach : out->bound;
        }
        jox_part_set_sphere(part, (low + high) * 0.5f);
    }
}

/* Makes Bullet's shape of the body: a compound of the parts, or the only part itself if its
   frame is that of the mass. */
void make_collision_shape(JoxBodyShape *out) {
    const btTransform &only = out->parts[0].frame;
    if (out->part_count == 1 && only.getOrigin().length2() < 1e-14f &&
        fabsf(only.getRotation().w()) > 0.9999999f) {
        out->collision = out->children[0];
        return;
    }
    btCompoundShape *compound = new btCompoundShape(out->part_count > 1, int(out->part_count));
    for (uint32_t p = 0; p < out->part_count; p++)
        compound->addChildShape(out->parts[p].frame, out->children[p]);
    out->collision = compound;
}

/* Stores a part's definition, from which a saved body is made again. */
void store_part_source(const JoxBodyPart *part, JoxBodyShape *out) {
    JoxBodyPartRecord *to = &out->source[out->part_count];
    const bool hull = part->shape.kind == JOX_SHAPE_HULL;
    to->kind = uint32_t(part->shape.kind);
    to->point_count = hull ? part->shape.point_count : 0;
    memcpy(to->size, part->shape.size, sizeof to->size);
    memcpy(to->position, part->position, sizeof to->position);
    memcpy(to->turn, part->turn, sizeof to->turn);
    to->mass = part->mass;
    to->density = part->density;
    const uint32_t first = out->source_point_count, numbers = 3 * to->point_count;
    jox_reserve(out->source_points, out->source_point_capacity, first + numbers);
    if (numbers)
        memcpy(out->source_points + first, part->shape.points, numbers * sizeof(double));
    out->source_point_count += numbers;
}

bool build_part(const JoxBodyPart *part, bool still, JoxBodyShape *out, Total *total,
                JoxText *error) {
    JoxConvexPart *made = &out->parts[out->part_count];
    Solid solid = {};
    btQuaternion turn;
    for (int i = 0; i < 3; i++)
        if (!is_in_range(part->position[i], -MOST_SIZE, MOST_SIZE))
            return refuse_shape(error, "a part must lie within 1000 m of its body");
    if (!make_unit_quaternion(part->turn, &turn))
        return refuse_shape(error, "a part's turn must be a finite quaternion");
    btCollisionShape *shape = make_part(&part->shape, made, &solid, error);
    if (shape)
        store_part_source(part, out);
    out->part_count++;
    if (!shape)
        return false;
    out->children[out->child_count++] = shape;
    made->frame = btTransform(turn, btVector3(float(part->position[0]), float(part->position[1]),
                                              float(part->position[2])));
    double mass = solid.volume;
    if (!still) {
        if (!compute_part_mass(part->mass, part->density, solid.volume, &mass, error))
            return false;
        if (!(mass > 0))
            return refuse_shape(error, "every part of a moving compound needs a mass or a density");
    }
    add_part_moments(total, solid, made->frame, mass);
    return true;
}

} // namespace

bool jox_body_shape_make(const JoxBodyDef *def, bool still, JoxBodyShape *out, JoxText *error) {
    *out = JoxBodyShape();
    JoxBodyPart single = JoxBodyPart();
    single.shape = def->shape;
    single.mass = def->mass;
    single.density = def->density;
    const JoxBodyPart *parts = &single;
    uint32_t count = 1;
    if (def->shape.kind == JOX_SHAPE_COMPOUND) {
        parts = def->shape.parts;
        count = def->shape.part_count;
        if (!parts || count < 1 || count > 4096)
            return refuse_shape(error, "a compound needs 1 to 4096 parts");
    }
    out->parts = static_cast<JoxConvexPart *>(jox_alloc(count, sizeof(JoxConvexPart)));
    out->children = static_cast<btCollisionShape **>(jox_alloc(count, sizeof(btCollisionShape *)));
    out->source = static_cast<JoxBodyPartRecord *>(jox_alloc(count, sizeof(JoxBodyPartRecord)));
    out->still = still;
    Total total = {};
    for (uint32_t i = 0; i < count; i++)
        if (!build_part(&parts[i], still, out, &total, error)) {
            jox_body_shape_free(out);
            return false;
        }
    compute_principal_axes(total, out);
    if (!still && !are_moments_valid(out->inertia)) {
        jox_body_shape_free(out);
        return refuse_shape(error, "a body is too thin for its length: make it thicker, or static");
    }
    transform_parts(out);
    make_collision_shape(out);
    if (still) {
        out->mass = 0;
        out->inertia = btVector3(0, 0, 0);
    }
    JOX_CHECK(jox_body_shape_check(out));
    return true;
}

void jox_body_shape_free(JoxBodyShape *shape) {
    if (shape->collision && (shape->child_count == 0 || shape->collision != shape->children[0]))
        delete shape->collision;
    for (uint32_t i = 0; i < shape->child_count; i++)
        delete shape->children[i];
    for (uint32_t i = 0; i < shape->part_count; i++) {
        jox_free(shape->parts[i].corners);
        jox_free(shape->parts[i].edges);
    }
    jox_free(shape->parts);
    jox_free(shape->children);
    jox_free(shape->source);
    jox_free(shape->source_points);
    *shape = JoxBodyShape();
}

/* ---- blocks ---- */

JoxBondGraph *jox_row_make_bonds(const JoxBodyDef *def, JoxText *error) {
    const JoxShape *shape = &def->shape;
    double blocks = double(shape->count[0]) * shape->count[1] * shape->count[2], volume = blocks;
    bool good = blocks >= 1 && blocks <= JOX_BONDS_MOST_BLOCKS;
    for (double size : shape->size) {
        good = good && size >= 0.001 && size <= 1000;
        volume *= size;
    }
    double mass = def->mass > 0 ? def->mass : def->density * volume;
    /* A static body needs no mass. */
    double each = mass > 0 && mass <= 1e9 ? mass / blocks : 1.0;
    JoxBondGraph *bonds =
        good ? jox_bonds_create(shape->count, shape->size, each, shape->bond) : nullptr;
    if (!bonds && error)
        jox_text_add(error, "glued blocks are 1 to 4096 of 0.001 to 1000 m, with bonds of more "
                            "than 0 N");
    return bonds;
}

bool jox_body_shape_of_blocks(const JoxBondGraph *bonds, bool still, JoxBodyShape *out,
                              JoxText *error) {
    JoxBodyPart *parts = static_cast<JoxBodyPart *>(jox_alloc(bonds->count, sizeof(JoxBodyPart)));
    for (uint32_t n = 0; n < bonds->count; n++) {
        parts[n].shape.kind = JOX_SHAPE_BOX;
        for (int i = 0; i < 3; i++)
            parts[n].shape.size[i] = bonds->size[i];
        jox_bonds_block_centre(bonds, n, parts[n].position);
        parts[n].mass = bonds->block_mass;
    }
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_COMPOUND;
    def.shape.parts = parts;
    def.shape.part_count = bonds->count;
    bool made = jox_body_shape_make(&def, still, out, error);
    jox_free(parts);
    return made;
}
