/// Elastic constants of an element from the change of its stress and its strain between two instants.
///
/// With s the symmetric part of the change of stress (tension positive; sum w (M_p - M_p before) / V over the grains
/// that lie in the element at the end and are in both snapshots, so that no grain is lost or won at its edges), e the
/// symmetric part of the displacement gradient, d the dimension, primes for deviators (t' = t - tr t / d): the
/// isotropic law
///     tr s = d K tr e,   s' = 2 G e'                  in 2D R 3.9 - 3.11 with R 3.13, 3.14 (plane strain)
/// has by least squares over its components (R 3.15)
///     K = tr s / (d tr e)                                                                         R 3.16
///     G = s' : e' / (2 e' : e')                                                                   R 3.17
/// and from them
///     2D, plane strain:  nu = (1 - G / K) / 2,              E = 3 G - G^2 / K                     R 3.18, 3.19
///     3D:                nu = (3 K - 2 G) / (2 (3 K + G)),  E = 9 K G / (3 K + G)
/// In 2D K = lambda + G. A layer that may grow in the third direction (plane stress) with the same K and G has
/// nu = (K - G) / (K + G) and E = 4 K G / (K + G) instead. `misfit` is |s - the law's| / |s| with the constants found:
/// 0 of an isotropic medium, and below 1 always. No strain gives no constants: NAN; no trace of the
/// strain, or none but round-off, no K, and no deviator no G.
///
/// Source: P. Roul, PhD thesis, Magdeburg 2009, 3.10. Units: SI.
#ifndef SCREE_AVERAGE_ELASTIC_H
#define SCREE_AVERAGE_ELASTIC_H

#include "average/strain.h"

typedef struct scree_average_elastic {
    double bulk, shear, young; ///< Pa
    double poisson, misfit;    ///< 1
} scree_average_elastic;

/// stress [Pa] and displacement gradient, of which the symmetric parts count.
scree_average_elastic scree_average_elastic_find(int dimension, const double stress[9], const double gradient[9]);

/// Tells of an element the change of stress, its invariants and those of the strain (`cundall`), the constants by that
/// strain, K and G also over the part of the element inside the sample, and by the other strains.
void scree_average_elastic_tell(const scree_average_sample *sample, const scree_average_value *value,
                                double gradient[SCREE_AVERAGE_STRAINS][9], scree_average_sink *sink, void *user);

/// Factor g of the trace of the fabric tensor, tr F = g volume_fraction coordination, that the sizes of the grains
/// predict when every grain is covered by its contacts to the same share, those with neighbours of mean size:
///     g = <a^d / W(a)> / (<a^d> <1 / W(a)>),  W = 2 arcsin(1 / (1 + a/<a>)) in 2D, 2 pi (1 - sqrt(1 - 1/(1 +
///     a/<a>)^2))
/// a the radius of the disc or sphere of the same area or volume. Sources: M. Madadi, O. Tsoungui, M. Laetzel, S.
/// Luding, Int. J. Solids Struct. 41, 2563 (2004); 3D M. R. Shaebani, M. Madadi, S. Luding, D. E. Wolf, Phys. Rev. E
/// 85, 011301 (2012).
double scree_average_fabric_factor(const scree_average_sample *sample);

#endif
