/* Unit tests in one program: `units NAME...` runs those in turn, as they are called by their files.
   UNITS is the list of them that the Makefile writes, a line UNIT(NAME) each; their main is called
   unit_NAME here. */
#include <stdio.h>
#include <string.h>

typedef int UnitMain(int argc, char **argv);

#define UNIT(name) UnitMain unit_##name;
#include UNITS
#undef UNIT

static const struct {
    const char *name;
    UnitMain *main;
} UNIT_TABLE[] = {
#define UNIT(name) {#name, unit_##name},
#include UNITS
#undef UNIT
};

static int run_unit(const char *name) {
    char *arguments[] = {(char *)name, NULL};
    for (size_t n = 0; n < sizeof UNIT_TABLE / sizeof *UNIT_TABLE; n++)
        if (!strcmp(name, UNIT_TABLE[n].name))
            return UNIT_TABLE[n].main(1, arguments);
    fprintf(stderr, "no unit test is called '%s'; they are called as the files of tests/unit\n",
            name);
    return 2;
}

int main(int argc, char **argv) {
    int worst = argc < 2 ? 2 : 0;
    if (argc < 2)
        fprintf(stderr, "usage: %s NAME...\n", argv[0]);
    for (int n = 1; n < argc; n++) {
        int status = run_unit(argv[n]);
        worst = status > worst ? status : worst;
    }
    return worst;
}
