/// Colour maps in polar CIELUV (lightness L*, chroma C, hue h; CIE 15:2004, D65 white), converted to sRGB (IEC
/// 61966-2-1). Polar CIELUV palettes after Zeileis, Hornik and Murrell 2009 (Comput. Stat. Data Anal. 53, 3259):
/// - sequential: a helix, L* and h linear in the position, C constant: equal steps in the data are equal steps to the
/// eye;
/// - diverging: two rays of constant hue from white, of the same lightness at both ends. Blue against orange-red stays
/// apart
///   for all common kinds of colour blindness, and lightness alone tells the magnitude.
/// The constants keep every colour inside the sRGB gamut to 0.01 (tested).
#include "view/colour.h"

#include <math.h>

static double clamp(double value)
{
    return value < 0 ? 0 : value > 1 ? 1 : value;
}

static double encode(double linear)
{
    linear = clamp(linear);
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static double decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/// Polar CIELUV to sRGB; lightness above 8 (the branch that all maps here lie on), hue in degrees.
static scree_colour from_polar(double lightness, double chroma, double hue)
{
    const double white_u = 0.1978398, white_v = 0.4683363;
    double angle = hue * M_PI / 180;
    double u = chroma * cos(angle) / (13 * lightness) + white_u;
    double v = chroma * sin(angle) / (13 * lightness) + white_v;
    double y = pow((lightness + 16) / 116, 3);
    double x = 9 * y * u / (4 * v);
    double z = y * (12 - 3 * u - 20 * v) / (4 * v);
    return (scree_colour){encode(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
                          encode(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
                          encode(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

scree_colour scree_colour_at(scree_colour_map map, double position)
{
    if (isnan(position)) return (scree_colour){0.62, 0.62, 0.62};
    position = clamp(position);
    if (map == SCREE_COLOUR_SEQUENTIAL) return from_polar(95 - 75 * position, 39, 85 + 195 * position);
    double distance = fabs(2 * position - 1);
    double lightness = 96 - 58 * distance;
    return position < 0.5 ? from_polar(lightness, 70 * distance, 252) : from_polar(lightness, 94 * distance, 20);
}

double scree_colour_lightness(scree_colour colour)
{
    double y = 0.2126729 * decode(colour.red) + 0.7151522 * decode(colour.green) + 0.0721750 * decode(colour.blue);
    return y > 216.0 / 24389 ? 116 * cbrt(y) - 16 : y * 24389 / 27;
}
