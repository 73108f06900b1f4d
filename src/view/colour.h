/// Colour maps for fields: perceptually even, colour-blind safe, computed from a formula (no tables).
#ifndef SCREE_VIEW_COLOUR_H
#define SCREE_VIEW_COLOUR_H

typedef enum scree_colour_map { SCREE_COLOUR_SEQUENTIAL, SCREE_COLOUR_DIVERGING } scree_colour_map;

/// sRGB, each component 0 to 1.
typedef struct scree_colour {
    double red, green, blue;
} scree_colour;

/// Colour at `position` (0 to 1, clamped) of `map`; NAN gives the neutral grey of undefined values.
/// Sequential: light to dark, so that more of a quantity is more ink. Diverging: blue, white, red.
scree_colour scree_colour_at(scree_colour_map map, double position);

/// CIE 1976 lightness L* of an sRGB colour, 0 (black) to 100 (white).
double scree_colour_lightness(scree_colour colour);

#endif
