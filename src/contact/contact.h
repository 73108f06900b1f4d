/// Contact forces: the batch kernels, and the contact table that measures and figures read.
///
/// Sign convention, the only one in the code: for the contact of `first` and `second` the unit normal n points from
/// second to first (P 2.A1); a positive normal force pushes them apart; the tangent is t = (-n_y, n_x), and the slip is
/// s = (v_first - v_second) . t - (a_first w_first + a_second w_second), so that pure rolling has s = 0
/// (P 2.A6 corrected). The force on first is f_n n + f_t t, on second the opposite; f_t opposes s.
/// The lever arms of slip and of tangential force are a = R - d/2 each (the contact point lies in the middle of the
/// overlap; kinematics.h says why slip and torque must have the same arm).
#ifndef SCREE_CONTACT_CONTACT_H
#define SCREE_CONTACT_CONTACT_H

#include "state/work.h"

/// Clears and refills state->sum with all contact forces at the present positions, and advances histories by one step.
/// Rows must hold v(n - 1/2), the velocity that brought the bodies here. Reads: rows, walls, pair list, quanta (set
/// right before by scree_contact_set_quanta). Writes: sums, wall force and shear, histories, ledger increments
/// (damping, friction, stiffness, plates, turnover), largest_overlap, work->flags. Valid after: everything about step
/// n. A caller that changes histories by hand counts up work->rebuilds.
void scree_contact_forces(const scree_model *model, scree_state *state, scree_work *work);

/// The part of it that is sums and histories alone; false: a force is out of the range of the quanta. For trials
/// (contact/trial.h).
bool scree_contact_sums(const scree_model *model, scree_state *state, scree_work *work);

/// Instruction set of the kernels on this machine when `wanted` is asked for in work->instruction_set: 2, 3, 4 for
/// x86-64-v2, v3, v4, at most what the machine has, which is also what 0 asks for; 0 on machines of another kind.
int scree_contact_instruction_set(int wanted);

/// Frees what scree_contact_forces keeps in work->contact_scratch. Call before scree_work_destroy.
void scree_contact_scratch_destroy(scree_work *work);

/// One touching contact, everything a measure needs. With `wall` second is the index of a plate, or SCREE_PRIMITIVE_ID
/// + element of the walls of the case.
typedef struct scree_contact {
    uint32_t first, second; ///< rows (not ids)
    bool wall;
    bool ghost;    ///< across a face of the periodic cell: of `first` and `second` one is where its ghost is
    bool membrane; ///< one of the two is a body of a membrane
    bool sliding;
    bool held;                 ///< a pair of the persistent list: it need not touch
    bool bonded;               ///< one whose bond stands: it may pull
    scree_vector normal;       ///< from second to first
    scree_vector tangent;      ///< 2D: (-n_y, n_x); 3D: direction of the tangential force on first, zero without one
    scree_vector point;        ///< m
    scree_vector branch;       ///< m, x_first - x_second; for a wall x_first - contact point
    double overlap;            ///< m
    double normal_force;       ///< N, >= 0 unless bonded
    double tangential_force;   ///< N, along t, on first; in 3D >= 0
    double slip;               ///< m/s along t in 2D, magnitude in 3D
    double elastic_normal;     ///< J
    double elastic_tangential; ///< J
} scree_contact;

/// The second of a contact is no grain, but a wall or a body of a membrane: a force from outside on the assembly.
static inline bool scree_contact_is_outer(const scree_contact *contact)
{
    return contact->wall || contact->membrane;
}

/// Id of the second of a contact, as files have it.
static inline uint32_t scree_contact_second_id(const scree_state *state, const scree_contact *contact)
{
    if (!contact->wall) return state->id[contact->second];
    return contact->second >= SCREE_PRIMITIVE_ID ? contact->second : SCREE_WALL_ID + contact->second;
}

typedef struct scree_contact_table {
    scree_contact *contact; ///< ordered by (id of first, id of second), walls last for each first
    size_t count, capacity;
} scree_contact_table;

/// Evaluates all touching contacts with the scalar reference law, histories untouched: forces equal those of the last
/// scree_contact_forces. Errors: memory.
scree_status scree_contact_table_build(const scree_model *model, const scree_state *state, const scree_work *work,
                                       scree_contact_table *table, scree_error *error) SCREE_MUST_USE;
void scree_contact_table_destroy(scree_contact_table *table);

/// Before the first step, behind scree_contact_table_build: contacts that bodies were placed with remember the energy
/// of the table, which they hold from the begin, so that the ledger takes none of it for work of the first step. Of
/// laws that remember energies alone. Errors: memory.
scree_status scree_contacts_were_placed(const scree_model *model, const scree_state *state, scree_work *work,
                                        scree_error *error) SCREE_MUST_USE;

/// Copies the histories of touching pairs into state->contact, sorted by (first id, second id), and what held pairs
/// remember to the persistent list.
scree_status scree_contacts_save(scree_state *state, const scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Takes the forces and torques that bodies which are about to go (going, by row: 1) exert on others out of the sums of
/// these. The list must be valid. Errors: memory, nothing has changed then. Cost: a pass over the list.
scree_status scree_contacts_take_out(const scree_model *model, scree_state *state, const scree_work *work,
                                     const uint8_t *going, scree_error *error) SCREE_MUST_USE;

/// Sets the quanta of forces and torques (powers of two, base/fixed.h) from a bound of any single contact force in the
/// next evaluation, K (d + 2 v dt)^1.5 + damping with the largest overlap and speed (bounds.c), and from `extra`, a
/// bound of boundary forces [N]. Call after the drift and before scree_contact_forces.
void scree_contact_set_quanta(const scree_model *model, scree_state *state, double extra);

#endif
