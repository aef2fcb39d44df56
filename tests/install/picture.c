/* A program of its own that uses the library with tools: `picture SCENE FILE` draws a scene as it
 * begins. */
#include <stdio.h>

#include <jostle_tools.h>

int main(int argc, char **argv) {
    if (argc != 3) {
        fputs("usage: picture SCENE FILE\n", stderr);
        return 2;
    }
    JoError error = {0};
    JoSceneDef scene = jo_default_scene_def();
    scene.path = argv[1];
    JoRenderDef def = jo_default_render_def();
    def.scene = &scene;
    def.out = argv[2];
    if (!jo_render(&def, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    return 0;
}
