/// What the shared library exports: the functions that these headers declare with SCREE_API, and nothing else.
#ifndef SCREE_API_H
#define SCREE_API_H

#if defined __GNUC__
#define SCREE_API __attribute__((visibility("default")))
#else
#define SCREE_API
#endif

#endif
