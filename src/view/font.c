/// Cairo and gnuplot ask fontconfig for the font of figures and take without a word what it has instead.
#include "view/font.h"

#include <fontconfig/fontconfig.h>

#include <stdio.h>
#include <string.h>

#define PACKAGE "Debian package fonts-dejavu-core"

/// What fontconfig gives in place of SCREE_FONT, to be destroyed by the caller; NULL: no font at all.
static FcPattern *nearest_font(void)
{
    FcResult result;
    FcPattern *asked = FcPatternCreate();
    if (!asked) return NULL;
    FcPattern *found = NULL;
    FcPatternAddString(asked, FC_FAMILY, (const FcChar8 *)SCREE_FONT);
    FcConfigSubstitute(NULL, asked, FcMatchPattern);
    FcDefaultSubstitute(asked);
    found = FcFontMatch(NULL, asked, &result);
    FcPatternDestroy(asked);
    return found;
}

bool scree_font_missing(char *said, size_t size)
{
    FcChar8 *file = NULL, *family = NULL;
    FcPattern *font = nearest_font();
    // A match without a file, as in an empty list of fonts, is nothing to write with.
    const bool any = font && FcPatternGetString(font, FC_FILE, 0, &file) == FcResultMatch &&
                     FcPatternGetString(font, FC_FAMILY, 0, &family) == FcResultMatch;
    const bool missing = !any || strcmp((const char *)family, SCREE_FONT) != 0;
    if (!any)
        (void)snprintf(said, size, "figures have no text, for no font is installed (" PACKAGE ")");
    else if (missing)
        (void)snprintf(said, size,
                       "figures are written in %s, for the font " SCREE_FONT " is not installed (" PACKAGE ")", family);
    if (font) FcPatternDestroy(font);
    return missing;
}
