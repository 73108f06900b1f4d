/// A source along a line. In two dimensions it may follow the plateau of the pile, layer by layer: it is as wide as
/// that is then, or a little less (R 3.1).
#include "module/key_rows.h"
#include "module/source.h"

#include "base/vectors.h"

#include <string.h>

enum { WIDTH_FIXED, WIDTH_PLATEAU };
enum { PAST_POINT, PAST_STOP };

typedef struct config {
    double start[3], end[3]; ///< m
    int width;               ///< WIDTH_...
    double plateau_depth;    ///< m
    double margin;           ///< m
    int past_plateau;        ///< PAST_...
} config;

static const scree_choice widths[] = {
    {"fixed", WIDTH_FIXED, "from `start` to `end`"},
    {"plateau", WIDTH_PLATEAU, "so for the first layer, and as wide as what is left of its plateau from the second on"},
    {0},
};

static const scree_choice pasts[] = {
    {"point", PAST_POINT, "what its plateau has, down to a point"},
    {"stop", PAST_STOP, "nothing: it has no more particles"},
    {0},
};

#define PLACE(member, text)                                                                                            \
    KEY(config, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = text)
static const scree_key keys[] = {
    PLACE(start, "One end of the line on which the centres of its particles are born."),
    PLACE(end, "The other end."),
    CHOICE(config, width, widths, .standard = "fixed", .meaning = "How wide it is; 2D."),
    NUMBER(config, plateau_depth, "m", .standard = "auto", ABOVE("0 m"), TO("1 km"), .when = "width=plateau",
           .meaning = "The plateau ends where the surface of the pile is so far below the mean level of the plateau "
                      "of the layer before; auto: a mean diameter."),
    NUMBER(config, margin, "m", .standard = "auto", FROM("0 m"), TO("1 km"), .when = "width=plateau",
           .meaning = "The line ends so far inside of the plateau, at both sides; auto: a mean radius."),
    CHOICE(config, past_plateau, pasts, .standard = "point", .when = "width=plateau",
           .meaning =
               "What is left of the line when no more than three particles of the mean size lie side by side in it."),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    double way[3];
    scree_subtract(c->end, c->start, way);
    *key = c->start[2] != 0 ? "start" : "end";
    if (dimension == 2 && (c->start[2] != 0 || c->end[2] != 0)) return "there is no z in two dimensions";
    *key = "end";
    if (!(scree_length(way) > 0)) return "a line needs a length: give another end, or a source: point";
    *key = "width";
    if (c->width != WIDTH_PLATEAU) return NULL;
    if (dimension == 3) return "a line follows the plateau in two dimensions only: give width: fixed, and the ends";
    *key = "end";
    return way[1] != 0 ? "a line that follows the plateau is level: give both ends the same height" : NULL;
}

static void place(const void *own, scree_source_place *place)
{
    const config *c = own;
    *place = (scree_source_place){.edges = 1};
    memcpy(place->origin, c->start, sizeof place->origin);
    scree_subtract(c->end, c->start, place->edge[0]);
}

static bool follows(const void *own, scree_source_plateau *plateau)
{
    const config *c = own;
    *plateau =
        (scree_source_plateau){.depth = c->plateau_depth, .margin = c->margin, .stops = c->past_plateau == PAST_STOP};
    return c->width == WIDTH_PLATEAU;
}

const scree_module scree_module_line = {
    .name = "line",
    .meaning = "Particles are born along a line, which may be as wide as the top of the pile.",
    .choice_of = CHOICE_OF(IS("sources", .meaning = "a line, which may follow the top of the pile")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .spreads = true,
    .source = &(const scree_source_kind){.wide = true, .wrong = wrong, .place = place, .follows = follows},
};
