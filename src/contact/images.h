/// What contacts with images of a periodic cell give to the bodies, and the virial.
#ifndef SCREE_CONTACT_IMAGES_H
#define SCREE_CONTACT_IMAGES_H

#include "state/periodic.h"
#include "state/work.h"

/// Adds the sums of all images to those of their bodies and, in a whole cell, sets scree_cell(state)->virial. Sums of
/// all rows (scree_row_count) are complete. Nothing without images.
void scree_images_fold(scree_state *state, scree_work *work);

#endif
