# Bonded spheres in one layer, hexagonal, JCFpm, with YADE (Debian package yade): the peer of bench/bonded.sh.
#   COUNT=5000 STEPS=2000 STEP=1e-7 yade -n -x -j1 bench/peers/yade_bonded.py
# The radius is 1 mm; motion is kept to the plane. As in the case beside it, the lowest and the highest row approach
# each other; nothing breaks. Prints bonds, steps, and seconds of processor time of the steps (set up and the first steps
# left out).
import math
import os
import time

count, steps, step = int(os.environ["COUNT"]), int(os.environ["STEPS"]), float(os.environ["STEP"])
radius = 1e-3
# As many columns as rows are high.
columns = int(round(math.sqrt(count * math.sqrt(3) / 2)))
rows = count // columns

# JCFpm: k_n = E 2 R1 R2 / (R1 + R2) of equal spheres E R; 1e7 N/m as in the case beside it. k_t = poisson k_n.
O.materials.append(
    JCFpmMat(
        young=1e7 / radius,
        poisson=0.5,
        density=2000,
        frictionAngle=math.atan(0.5),
        type=1,
        tensileStrength=1e30,
        cohesion=1e30,
        label="rock",
    )
)
for r in range(rows):
    for c in range(columns):
        x, y = (2 * c + (r % 2)) * radius, r * math.sqrt(3) * radius
        body = O.bodies[O.bodies.append(sphere((x, y, 0), radius, material="rock"))]
        body.state.blockedDOFs = "zXY"
        if r in (0, rows - 1):
            body.state.blockedDOFs = "xyzXYZ"
            body.state.vel = (0, 5e-3 if r == 0 else -5e-3, 0)

first = 1.05  # bonds join what lies within this times the radii; then spheres touch as usual
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=first, label="reach")], verletDist=0.1 * radius),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=first, label="seen")],
        [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)],
        [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(recordCracks=False)],
    ),
    NewtonIntegrator(damping=0),
]
O.dt = step
O.step()
reach.aabbEnlargeFactor = seen.interactionDetectionFactor = 1
O.run(100, True)

begin = time.process_time()
O.run(steps, True)
seconds = time.process_time() - begin
bonds = sum(1 for i in O.interactions if i.isReal and i.phys.isCohesive)
force = sum(O.forces.f(b.id)[1] for b in O.bodies if b.state.blockedDOFs == "xyzXYZ" and b.state.vel[1] < 0)
print("yade: spheres %d bonds %d steps %d seconds %.3f force %.6g N" % (len(O.bodies), bonds, steps, seconds, force))
os._exit(0)
