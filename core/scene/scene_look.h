/* The look of a scene besides people, bodies and walls: title, camera, colouring, places, floor and
   scenery. The live page and pictures draw it, and recordings hold it as JSON, so that they show it
   without the scene's file. */
#ifndef JOX_SCENE_SCENE_LOOK_H
#define JOX_SCENE_SCENE_LOOK_H

#include "base/format/json_writer.h"
#include "scene/scene.h"

typedef struct JoxSceneLook {
    char *title, *about; /* NULL: none */
    JoxSceneCamera camera;
    uint32_t colour, field; /* indices of jox_scene_colours and jox_scene_fields */
    JoxPlace *places;
    uint32_t place_count;
    uint32_t floor; /* index of jox_floor_names */
    JoxScenery *scenery;
    uint32_t scenery_count;
    void *memory; /* JoxArena: owns the look that was read; NULL: its specification does */
} JoxSceneLook;

/* Returns the look of a specification, valid as long as that; for NULL a plain floor, on which no
   field is shown. */
JoxSceneLook jox_scene_look(const JoxSceneSpec *spec);
/* Add "camera", which may be null; "floor" and "scenery": to an open object. */
void jox_scene_add_camera(const JoxSceneLook *look, JoxJson *json);
void jox_scene_add_scenery(const JoxSceneLook *look, JoxJson *json);
/* Appends the look as a JSON object. */
void jox_scene_write_look(const JoxSceneLook *look, JoxText *out);
/* Reads such an object, of a recording that may be hostile. Returns false, with a plain floor in
   `look`, if any value is wrong. Free it by jox_scene_free_look. */
bool jox_scene_read_look(const char *text, JoxSceneLook *look);
void jox_scene_free_look(JoxSceneLook *look);

#endif
