#!/usr/bin/env bash
# make_gallery.sh SCREE: makes docs/gallery.md and the pictures in docs/gallery/ anew, by the commands that stand on the
# page. They run in a folder of their own, one after the other.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
export PATH SCREE_PIXELS=720
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp "$here"/tutorials/*.yaml "$here"/tutorials/*.csv "$scratch"
mkdir "$scratch/pictures" "$scratch/records"
[ -e "$here"/../records/pile-line.tar.xz ] || { echo "make_gallery.sh: there is no record of the sweep pile-line yet: pour its piles first (docs/full-runs.md)" >&2; exit 2; }
cp "$here"/../records/pile-line.tar.xz "$scratch/records"
cd "$scratch"

# show TITLE TEXT PICTURE=FIGURE... <COMMANDS: runs the commands; the figures become pictures of the page.
show() {
    local title=$1 text=$2 commands seconds picture TIMEFORMAT=%U
    shift 2
    commands=$(cat)
    echo "$title" >&2
    { time bash -eu -c "$commands" >log.txt 2>&1 || { cat log.txt >&2; exit 1; }; } 2>time.txt || { cat time.txt >&2; exit 1; }
    seconds=$(LC_ALL=C awk '{ printf $1 < 9.5 ? "%.1g" : "%.2g", $1 }' time.txt)
    printf '\n## %s\n\n```sh\n%s\n```\n\n*%s s.* %s\n' "$title" "$commands" "$seconds" "$text" >>gallery.md
    for picture; do
        cp "${picture#*=}.png" "pictures/${picture%%=*}.png"
        printf '\n![%s](gallery/%s.png)\n' "$title" "${picture%%=*}" >>gallery.md
    done
}

cat >gallery.md <<'END'
# Gallery

Pictures as Scree draws them, each below the commands that made it; `make gallery` makes this page anew. The runs are small, of some seconds each: `--quick` is a smaller form of a built-in case (leave it out for the whole one), `--set` changes single values. `scree plot FOLDER --list` names the other figures of a run. Files of cases without `--quick` are those of the [tutorials](tutorials/README.md), full piles those of [records](../records/README.md). Seconds are those of one core.
END

show 'Shear band of a biaxial test' 'Discs between rigid plates, pressure on the Delaunay boundary. How much the cells between the grains are distorted in a window of axial strain, and the band that is found in it.' \
    biaxial-distortion=biaxial/figures/distortion-08-12 <<'END'
scree run biaxial --quick -o biaxial
END
show 'Stress ratio of a biaxial test' 'Axial over lateral stress of the same run, by forces on plates and from contacts.' \
    biaxial-stress-ratio=biaxial/figures/stress-ratio <<'END'
scree plot biaxial --only stress-ratio
END
show 'Force chains and directions of contacts' 'The same sample at 3 % of strain: chains of large forces, and how contacts and forces are directed ([averages](theory/averages.md)).' \
    chains=measured/chains rose=measured/rose <<'END'
scree measure biaxial --fields stress,fabric --at '3 %' -o measured
END
show 'Grading' 'What was drawn beside the sieve curve that was asked for ([tutorial](tutorials/grading.md)).' \
    grading=sand/figures/sizes <<'END'
scree run sand.yaml --set particles.count=300 --set stages.compress.strain='1 %' --no-figures -o sand
scree plot sand --only sizes
END
show 'Triaxial test' 'Spheres between plates, pressure on their Delaunay hull.' \
    triaxial=triaxial/figures/packing-end <<'END'
scree run triaxial --quick --set particles.count=200 -o triaxial
END
show 'Simple shear of a periodic cell' 'Displacements of grains in a window of strain, less those of the cell.' \
    shear-fluctuations=shear/figures/fluctuations-10-20 <<'END'
scree run periodic-shear --quick --set particles.count=500 -o shear
END
show 'Undrained cyclic test' 'Constant volume, turned where the deviator stress has come to 25 kPa: the mean stress goes down from cycle to cycle, until little is left.' \
    undrained-cyclic=cyclic/figures/path-p-q <<'END'
scree run undrained-cyclic --quick --set particles.count=500 -o cyclic
END
show 'Earth pressure at rest' 'Compressed without lateral strain, and unloaded again.' \
    oedometer=oedometer/figures/path-p-q <<'END'
scree run oedometer --quick -o oedometer
END
show 'Polygons' 'A biaxial test of convex polygons: how they have turned, and the forces between them.' \
    polygons=polygons/figures/packing-end polygons-forces=polygons/figures/forces-end <<'END'
scree run polygons-biaxial --quick -o polygons
END
show 'Hopper' 'Discs run out of a funnel ([tutorial](tutorials/hopper.md)): speeds, and how many have come out.' \
    hopper=hopper/figures/scene-speed-000004 outflow=hopper/figures/outflow <<'END'
scree run hopper.yaml -o hopper
scree plot hopper --scene speed --at '0.3 s'
END
show 'Rotating drum' 'A section through the spheres, and the angle of their surface over time ([tutorial](tutorials/drum.md)).' \
    drum=drum/figures/scene-velocity_x-section-000011 drum-angle=drum/figures/surface-angle <<'END'
scree run drum.yaml -o drum
scree plot drum --scene velocity_x --section
END
show 'Sand pile' 'Discs that resist rolling, through a funnel onto a plate: when each has come.' \
    pile=pile/figures/pile <<'END'
scree run pile-hopper --quick -o pile
END
show 'Pile of polygons' 'A full pile of the sweep `pile-line`, as records keep it (these pictures: that of commit 54fef465, poured by an earlier rule of sleep): polygons rained layer by layer from a line as wide as the plateau, and when each has come.' \
    pile-polygons=pile-line/members/000-narrow-seed=501/figures/scene-birth-000016 <<'END'
tar -xJf records/pile-line.tar.xz
scree plot pile-line/members/000-narrow-seed=501 --scene birth
END
show 'Pressure inside a pile' 'The same pile: vertical pressure, and the axis of the largest one ([averages](theory/averages.md)).' \
    pile-map=mapped/map-stress-vertical <<'END'
scree measure pile-line/members/000-narrow-seed=501 --fields stress --grid 100x40 -o mapped
END
show 'Cuts through piles, and theories fitted to them' 'The mean of all full piles there with bands of 95 %, and the wedge with a dip, without, with a peak, and with the boundary of its core as it fits best. Bands of so few piles are too narrow, which the program says.' \
    pile-cuts=piles/cuts-stress-vertical pile-fit=piles/fits-vertical <<'END'
scree measure pile-line/members/* --fields stress --fit wedge -o piles
END
show 'Theory of sand piles' 'Vertical stress at the base of a wedge of 28 degrees, from closed forms ([theory](theory/piles.md)).' \
    wedge=wedge/vertical <<'END'
scree theory wedge --phi 28 -o wedge
END
show 'Layer under a load on one grain' 'The force network, and the vertical stress at the base beside that of elastic bodies ([theory](theory/layers.md)).' \
    layer-forces=layer/figures/forces-end layer-response=layer/figures/response-base <<'END'
scree run layer-response --quick -o layer
END
show 'Bonded strip, pulled until it breaks' 'Bonds that each grain has lost.' \
    bonds=strip/figures/cracks <<'END'
scree run bond-tension --quick -o strip
END
show 'Wave through a bar' 'Bonded discs that deform: displacements at ten receivers, A, C, E, G, I nearer to the source than B, D, F, H, J.' \
    waves=bar/figures/wave-receivers <<'END'
scree run ddem-waves --quick -o bar
END
show 'Rotation of one grain' 'One disc of a sample under pressure is turned: who turns with it, and how this decays with the distance ([study](rotation-length.md)).' \
    rotation=turned/figures/rotation-map rotation-decay=turned/figures/rotation-decay <<'END'
scree run rotation-length --quick -o turned
END
show 'Impact of grains that stick' 'Restitution of two spheres under the law of Johnson, Kendall and Roberts, beside its closed form ([theory](theory/adhesion.md)).' \
    cohesion=impacts/figures/restitution-over-speed <<'END'
scree sweep cohesive-impact --quick -o impacts
END

rm -rf "$here/gallery"
cp -r pictures "$here/gallery"
cp gallery.md "$here/gallery.md"
