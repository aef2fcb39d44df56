/* Updates the mean load of each wall piece in each frame, and writes the figures. */
#include "record/danger/wall_loads.h"

#include <math.h>

#include "base/mem.h"
#include "record/storey_figures.h"

const char jox_rail_what[] = "steel railings were bent in fatal crowds";
const char jox_rail_source[] = "J. J. Fruin, The causes and prevention of crowd disasters, 1993";

static bool have_equal_coordinates(JoxV2 a, JoxV2 b) {
    return a.x == b.x && a.y == b.y;
}

/* Returns the piece of load k: the one of the last frame unless walls changed, else one with the
   same end points, or a new one. */
static JoxDangerPiece *find_piece(JoxDangerWalls *walls, const JoxWallLoad *load, uint32_t k) {
    uint32_t p = walls->order[k];
    if (p < walls->count && have_equal_coordinates(walls->items[p].from, load->from) &&
        have_equal_coordinates(walls->items[p].to, load->to))
        return &walls->items[p];
    for (p = 0; p < walls->count; p++)
        if (have_equal_coordinates(walls->items[p].from, load->from) &&
            have_equal_coordinates(walls->items[p].to, load->to))
            break;
    if (p == walls->count) {
        JOX_RESERVE(walls->items, walls->capacity, walls->count + 1);
        walls->items[walls->count++] =
            (JoxDangerPiece){.from = load->from, .to = load->to, .most_time = NAN, .first = NAN};
    }
    walls->order[k] = p;
    return &walls->items[p];
}

/* Updates maximum and time over the limit of piece p. */
static void update_piece_figures(JoxDangerWalls *walls, uint32_t p, double time, double duration) {
    JoxDangerPiece *piece = &walls->items[p];
    if (piece->load > piece->most) {
        piece->most = piece->load;
        piece->most_time = time;
        if (piece->most > walls->items[walls->most].most)
            walls->most = p;
    }
    if ((double)piece->load < JOX_RAIL_LIMIT)
        return;
    piece->seconds += duration;
    walls->piece_s += duration;
    walls->longest = fmax(walls->longest, piece->seconds);
    if (isnan(piece->first)) {
        piece->first = time;
        if (walls->over++ == 0)
            walls->first = p;
    }
}

void jox_danger_walls_frame(JoxDangerWalls *walls, const JoxFrame *frame, double duration,
                            float share) {
    if (!frame->wall_loads)
        return;
    walls->known = true;
    for (uint32_t p = 0; p < walls->count; p++)
        walls->items[p].load *= 1.0f - share; /* pieces of an open gate have no load */
    JOX_RESERVE_ZEROED(walls->order, walls->order_capacity, frame->wall_load_count);
    for (uint32_t k = 0; k < frame->wall_load_count; k++)
        find_piece(walls, &frame->wall_loads[k], k)->load += share * frame->wall_loads[k].load;
    for (uint32_t p = 0; p < walls->count; p++)
        update_piece_figures(walls, p, frame->time, duration);
}

double jox_danger_walls_greatest_load(const JoxDangerWalls *walls) {
    double most = walls->known ? 0.0 : NAN;
    for (uint32_t p = 0; p < walls->count; p++)
        most = fmax(most, (double)walls->items[p].load);
    return most;
}

double jox_danger_piece_line_load(const JoxDangerPiece *piece) {
    const double length = (double)jox_length(jox_sub(piece->to, piece->from));
    return length > 0.0 ? (double)piece->most / length : NAN;
}

JoxV2 jox_danger_piece_in_plan(const JoxStoreys *storeys, const JoxDangerPiece *piece,
                               JoxV2 point) {
    const JoxV2 middle = jox_danger_piece_middle(piece);
    return jox_add(jox_in_plan(storeys, middle), jox_sub(point, middle));
}

static void write_piece_middle(JoxJson *json, const JoxStoreys *storeys,
                               const JoxDangerPiece *piece, const char *prefix) {
    const JoxV2 none = {0.0f, 0.0f};
    const JoxV2 middle = piece ? jox_danger_piece_middle(piece) : none;
    jox_json_add_position(json, prefix, storeys, middle, piece != NULL);
}

void jox_danger_walls_json(const JoxDangerWalls *walls, const JoxStoreys *storeys, double end,
                           JoxJson *json) {
    if (!walls->known) {
        jox_json_null(json, "walls");
        return;
    }
    const JoxDangerPiece *most = walls->count ? &walls->items[walls->most] : NULL;
    const JoxDangerPiece *first = walls->over ? &walls->items[walls->first] : NULL;
    jox_json_object(json, "walls");
    jox_json_whole(json, "pieces", walls->count);
    jox_json_number(json, "load_max", most ? (double)most->most : 0.0);
    jox_json_number(json, "load_max_s", most ? most->most_time : NAN);
    write_piece_middle(json, storeys, most, "load_max_");
    jox_json_object(json, "rail_4500");
    jox_json_whole(json, "pieces", walls->over);
    jox_json_number(json, "limit", JOX_RAIL_LIMIT);
    jox_json_number(json, "piece_s", walls->piece_s);
    jox_json_number(json, "longest_s", walls->longest);
    jox_json_number(json, "first_s", first ? first->first : NAN);
    write_piece_middle(json, storeys, first, "first_");
    jox_json_number(json, "since_min", first ? (end - first->first) / 60.0 : NAN);
    jox_json_end(json);
    jox_json_end(json);
}

void jox_danger_walls_sections(JoxDangerWalls *walls, JoxSections *s) {
    JOX_SECTION_ARRAY(s, "pieces", walls->items, walls->count, walls->capacity);
    JOX_SECTION_ROOM(s, "order", walls->order, walls->order_capacity);
    JOX_SECTION(s, "known", walls->known);
    JOX_SECTION(s, "over", walls->over);
    JOX_SECTION(s, "piece_s", walls->piece_s);
    JOX_SECTION(s, "longest", walls->longest);
    JOX_SECTION(s, "first", walls->first);
    JOX_SECTION(s, "greatest", walls->most);
    const uint32_t least = walls->count ? walls->count : 1;
    if (!s->failed && (walls->first >= least || walls->most >= least))
        jox_sections_fail(s, "pieces", "an index of a piece is out of range");
    if (s->failed)
        walls->first = walls->most = 0;
}

void jox_danger_walls_free(JoxDangerWalls *walls) {
    jox_free(walls->items);
    jox_free(walls->order);
}
