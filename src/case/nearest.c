/// The name that was probably meant. Optimal string alignment (Damerau 1964, Levenshtein 1966: insertions, deletions,
/// substitutions and swaps of neighbours count one each), ignoring case and taking '-' for '_'.
/// Cost: product of the lengths, which are limited to 80 letters.
#include "case/nearest.h"

#include <scree/scree.h>

#include <ctype.h>
#include <string.h>

enum { LONGEST = 80 };

static char folded(char c)
{
    return c == '-' ? '_' : (char)tolower((unsigned char)c);
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/// Distance of `a` and `b`, of m and n letters, at most LONGEST.
static size_t letters_wrong(const char *a, size_t m, const char *b, size_t n)
{
    size_t rows[3][LONGEST + 1];
    size_t *before = rows[0], *last = rows[1], *now = rows[2];
    for (size_t j = 0; j <= n; j++) last[j] = j;
    for (size_t i = 1; i <= m; i++) {
        now[0] = i;
        for (size_t j = 1; j <= n; j++) {
            bool same = folded(a[i - 1]) == folded(b[j - 1]);
            now[j] = smaller(smaller(last[j], now[j - 1]) + 1, last[j - 1] + !same);
            bool swapped =
                i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) && folded(a[i - 2]) == folded(b[j - 1]);
            if (swapped) now[j] = smaller(now[j], before[j - 2] + 1);
        }
        size_t *free_row = before;
        before = last;
        last = now;
        now = free_row;
    }
    return last[n];
}

bool scree_letters_near(const char *text, const char *name, size_t *wrong)
{
    size_t m = strnlen(text, LONGEST + 1), n = strnlen(name, LONGEST + 1);
    size_t longer = m > n ? m : n, shorter = m > n ? n : m;
    if (longer > LONGEST || 3 * (longer - shorter) > longer) return false;
    *wrong = letters_wrong(text, m, name, n);
    return 3 * *wrong <= longer;
}

/// Whether `part` stands in `whole` as one or more whole words (words are parted by '_', '-' or '.').
static bool holds_words(const char *whole, const char *part)
{
    size_t m = strlen(whole), n = strnlen(part, LONGEST);
    for (size_t start = 0; n >= 3 && start + n <= m; start++) {
        size_t same = 0;
        while (same < n && folded(whole[start + same]) == folded(part[same])) same++;
        bool begins = start == 0 || strchr("_-.", whole[start - 1]);
        bool ends = start + n == m || strchr("_-.", whole[start + n]);
        if (same == n && begins && ends) return true;
    }
    return false;
}

const char *scree_nearest(const char *text, const char *const *names, size_t count)
{
    const char *nearest = NULL;
    size_t fewest = SIZE_MAX;
    for (size_t i = 0; i < count; i++) {
        size_t wrong;
        if (!scree_letters_near(text, names[i], &wrong) || wrong >= fewest) continue;
        fewest = wrong;
        nearest = names[i];
    }
    // "poisson" for "poisson_ratio", "contact_law" for "law".
    for (size_t i = 0; i < count && !nearest; i++)
        if (holds_words(names[i], text) || holds_words(text, names[i])) nearest = names[i];
    return nearest;
}
