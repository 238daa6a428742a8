/* The engine's algorithm written by hand in C: the limit for what compiling the Python engine can reach.
 *
 * It does what `mechanism_fmu.engine` does for the guided ratchet of Pennestrì, Valentini and Vita, step by step, with
 * the same tables, constants and tolerances, and sums in the same order, so that both take the same steps. Left out is
 * what the guided ratchet does not have: friction, patterns, stops, logical functions, contacts that must be chosen.
 * Plain arrays with greatest sizes; the actual sizes are data, as in the engine.
 *
 * q holds x, y, phi of the centre of mass of each body in turn; the ground is the frame after the last body.
 * y = (q, qd, work, loss). SI units.
 */

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum {
    MAX_BODIES = 4,
    MAX_PINS = 5,
    MAX_FORCES = 8,
    MAX_CONTACTS = 4,
    MAX_INPUTS = 8,
    MAX_COLUMNS = 16, /* 3 a body and 3 for the ground, rounded up */
    MAX_ROWS = 2 * MAX_PINS + MAX_CONTACTS + 1,
    MAX_UNKNOWNS = 6 * MAX_BODIES + 2
};

/* ---- the mechanism as tables; benchmarks/c_limit/library.py declares the same structs ---- */

typedef struct { /* point_i of body i stays on point_j of body j */
    int i, j;
    double point_i[2], point_j[2];
} Pin;

enum { TORQUE, TORSION_SPRING, DAMPER, SHAFT };

typedef struct {
    int kind, body, reaction;
    double data[4]; /* torque | stiffness, free angle, preload | damping | stiffness, damping, angle, speed */
} Force;

typedef struct { /* a point of body i stays in front of a line (point, normal) in body j */
    int i, j, guided;
    double point[2], line[4], restitution;
} Contact;

typedef struct { /* writes force[force].data[column] */
    int force, column;
} Input;

typedef struct {
    int bodies, pins, forces, contacts, inputs;
    double inverse_mass[MAX_COLUMNS], inverse_root_mass[MAX_COLUMNS];
    Pin pin[MAX_PINS];
    Force force[MAX_FORCES];
    Contact contact[MAX_CONTACTS];
    Input input[MAX_INPUTS];
    double relative_tolerance, alpha, beta;
} Mechanism;

/* ---- state and scratch of one instance ---- */

enum Guard { GUARD_NONE, GUARD_GAP, GUARD_PUSH };
enum Status { OK, STEP_TOO_SMALL, TOO_MANY_STEPS, CHATTERING };

typedef struct {
    double x, y, phi, cosine, sine, x_rate, y_rate, phi_rate;
} Frame;

typedef struct {
    bool closed, touching; /* touching: the gap was zero when the step began */
    double pull_time;      /* when it first pulled; infinity: never */
} Mode;

typedef struct {
    double time, contact, closing_speed, impulse;
} Impact;

/* Everything that a saved state restores. */
typedef struct {
    double time, step_start, step_end, step_size, next_step; /* time: up to which the outside has come */
    int pending_guard, pending_contact;                      /* the event that waits at step_end */
    int steps, impacts, pulls;
    double lost; /* energy lost in impacts */
    double input[MAX_INPUTS], held_input[MAX_INPUTS];
    double y_end[MAX_UNKNOWNS], dy_end[MAX_UNKNOWNS], dense[5][MAX_UNKNOWNS];
    Mode mode[MAX_CONTACTS];
    Impact last_impact;
} State;

typedef struct {
    Mechanism mechanism;
    State state;
    int coordinates, unknowns, joint_rows;
    Frame frame[MAX_BODIES + 1];
    /* constraint rows: Phi, Phi', gamma, Phi_q */
    double residual[MAX_ROWS], residual_rate[MAX_ROWS], gamma[MAX_ROWS], jacobian[MAX_ROWS][MAX_COLUMNS];
    int row[MAX_CONTACTS]; /* of a closed contact */
    double force[MAX_COLUMNS], free_acceleration[MAX_COLUMNS];
    /* minimum-norm problem D z = b and its factors */
    double scaled[MAX_ROWS][MAX_COLUMNS], right_side[MAX_ROWS], solution[MAX_COLUMNS], multiplier[MAX_ROWS];
    double basis[MAX_ROWS][MAX_COLUMNS], triangle[MAX_ROWS][MAX_ROWS], coefficient[MAX_ROWS];
    double column_basis[MAX_ROWS][MAX_ROWS], column_triangle[MAX_ROWS][MAX_ROWS], dual[MAX_ROWS];
    double length[MAX_ROWS], left[MAX_ROWS]; /* squared length of a row, and of what is left of it */
    int order[MAX_ROWS];
    /* the step last tried */
    double k[7][MAX_UNKNOWNS], y_start[MAX_UNKNOWNS], y_stage[MAX_UNKNOWNS], y_new[MAX_UNKNOWNS];
    double new_dense[5][MAX_UNKNOWNS], y_at[MAX_UNKNOWNS], dy_at[MAX_UNKNOWNS];
    double least_push[MAX_CONTACTS]; /* least force of a closed contact over its tolerance */
    double closing[MAX_CONTACTS];
} Engine;

/* ---- kinematics and rows ---- */

static void place_bodies(Engine *e, const double *y)
{
    const double *rate = y + e->coordinates;
    for (int i = 0; i < e->mechanism.bodies; i++, y += 3, rate += 3)
        e->frame[i] = (Frame){y[0], y[1], y[2], cos(y[2]), sin(y[2]), rate[0], rate[1], rate[2]};
}

/* Phi = r_i + a - r_j - b, Phi_q = [1, R a, -1, -R b], gamma = a phi_i'^2 - b phi_j'^2; a = A_i s_i, b = A_j s_j. */
static void pin_rows(Engine *e, const Pin *pin, int row)
{
    const Frame *i = &e->frame[pin->i], *j = &e->frame[pin->j];
    double ax = i->cosine * pin->point_i[0] - i->sine * pin->point_i[1];
    double ay = i->sine * pin->point_i[0] + i->cosine * pin->point_i[1];
    double bx = j->cosine * pin->point_j[0] - j->sine * pin->point_j[1];
    double by = j->sine * pin->point_j[0] + j->cosine * pin->point_j[1];
    double wi = i->phi_rate, wj = j->phi_rate;
    e->residual[row] = i->x + ax - j->x - bx;
    e->residual[row + 1] = i->y + ay - j->y - by;
    e->residual_rate[row] = i->x_rate - ay * wi - j->x_rate + by * wj;
    e->residual_rate[row + 1] = i->y_rate + ax * wi - j->y_rate - bx * wj;
    e->gamma[row] = ax * wi * wi - bx * wj * wj;
    e->gamma[row + 1] = ay * wi * wi - by * wj * wj;
    double *first = e->jacobian[row], *second = e->jacobian[row + 1];
    memset(first, 0, sizeof e->jacobian[row]);
    memset(second, 0, sizeof e->jacobian[row]);
    first[3 * pin->i] = 1.0;
    first[3 * pin->i + 2] = -ay;
    second[3 * pin->i + 1] = 1.0;
    second[3 * pin->i + 2] = ax;
    first[3 * pin->j] = -1.0;
    first[3 * pin->j + 2] = by;
    second[3 * pin->j + 1] = -1.0;
    second[3 * pin->j + 2] = -bx;
}

/* s = n.e - n'.p', s_q = [n, n.Ra, -n, (R n).e], s' = n.e' + u (R n).e, gamma = n.a phi_i'^2 + n.e u^2 - 2 u (R n).e';
 * n = A_j n', a = A_i s_i, e = r_i + a - r_j, u = phi_j'. */
static void contact_row(Engine *e, const Contact *contact, int row)
{
    const Frame *i = &e->frame[contact->i], *j = &e->frame[contact->j];
    const double *point = contact->point, *line = contact->line;
    double ax = i->cosine * point[0] - i->sine * point[1];
    double ay = i->sine * point[0] + i->cosine * point[1];
    double nx = j->cosine * line[2] - j->sine * line[3];
    double ny = j->sine * line[2] + j->cosine * line[3];
    double ui = i->phi_rate, uj = j->phi_rate;
    double ex = i->x + ax - j->x;
    double ey = i->y + ay - j->y;
    double ex_rate = i->x_rate - ay * ui - j->x_rate;
    double ey_rate = i->y_rate + ax * ui - j->y_rate;
    double along = nx * ey - ny * ex;
    e->residual[row] = nx * ex + ny * ey - line[2] * line[0] - line[3] * line[1];
    e->residual_rate[row] = nx * ex_rate + ny * ey_rate + uj * along;
    e->gamma[row] =
        (nx * ax + ny * ay) * ui * ui + (nx * ex + ny * ey) * uj * uj - 2.0 * uj * (nx * ey_rate - ny * ex_rate);
    double *entry = e->jacobian[row];
    memset(entry, 0, sizeof e->jacobian[row]);
    entry[3 * contact->i] = nx;
    entry[3 * contact->i + 1] = ny;
    entry[3 * contact->i + 2] = ny * ax - nx * ay;
    entry[3 * contact->j] = -nx;
    entry[3 * contact->j + 1] = -ny;
    entry[3 * contact->j + 2] = along;
}

/* Write the rows of all pins and closed contacts; return their number. */
static int active_rows(Engine *e)
{
    const Mechanism *m = &e->mechanism;
    for (int p = 0; p < m->pins; p++)
        pin_rows(e, &m->pin[p], 2 * p);
    int count = e->joint_rows;
    for (int c = 0; c < m->contacts; c++)
        if (e->state.mode[c].closed) {
            contact_row(e, &m->contact[c], count);
            e->row[c] = count++;
        }
    return count;
}

typedef struct {
    double value, rate;
} Gap;

/* Gap and gap rate of a contact at the bodies' pose. */
static Gap gap(Engine *e, int contact)
{
    int spare = MAX_ROWS - 1;
    contact_row(e, &e->mechanism.contact[contact], spare);
    return (Gap){e->residual[spare], e->residual_rate[spare]};
}

static double largest(const double *values, int count)
{
    double found = 0.0;
    for (int k = 0; k < count; k++)
        found = fabs(values[k]) > found ? fabs(values[k]) : found;
    return found;
}

/* ---- z = D^+ b by row-pivoted modified Gram-Schmidt, and the multipliers of the same solve ---- */

static const double RANK_TOLERANCE = 1e-10;       /* less of a row's length is left: it depends on those before */
static const double REORTHOGONALISE_BELOW = 0.25; /* this fraction of the squared length */
static const double RECOMPUTE_BELOW = 1e-4;       /* below, subtraction has cancelled what is left */

static double dot(const double *a, const double *b, int length)
{
    double first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
    int k = 0;
    for (; k + 4 <= length; k += 4) {
        first += a[k] * b[k];
        second += a[k + 1] * b[k + 1];
        third += a[k + 2] * b[k + 2];
        fourth += a[k + 3] * b[k + 3];
    }
    for (; k < length; k++)
        first += a[k] * b[k];
    return (first + second) + (third + fourth);
}

static void add_multiple(double *restrict target, double factor, const double *restrict source, int length)
{
    for (int k = 0; k < length; k++)
        target[k] += factor * source[k];
}

/* Move the row with the largest remaining fraction of its length to place r; false when none has any left. */
static bool choose_pivot(Engine *e, int r, int count)
{
    int best = r;
    double best_fraction = -1.0;
    for (int s = r; s < count; s++) {
        int i = e->order[s];
        double fraction = e->length[i] > 0.0 ? e->left[i] / e->length[i] : 0.0;
        if (fraction > best_fraction) {
            best_fraction = fraction;
            best = s;
        }
    }
    int chosen = e->order[best];
    e->order[best] = e->order[r];
    e->order[r] = chosen;
    return best_fraction > RANK_TOLERANCE * RANK_TOLERANCE;
}

/* D = L Q: row order[r] of `basis` is the r-th basis row, triangle[i][r] its share in row i. Return the rank. */
static int orthogonalise(Engine *e, int count, int width)
{
    for (int i = 0; i < count; i++) {
        e->order[i] = i;
        memcpy(e->basis[i], e->scaled[i], width * sizeof(double));
        e->length[i] = e->left[i] = dot(e->basis[i], e->basis[i], width);
    }
    for (int r = 0; r < count; r++) {
        if (!choose_pivot(e, r, count))
            return r;
        int p = e->order[r];
        double *pivot = e->basis[p];
        double square = dot(pivot, pivot, width);
        if (square < REORTHOGONALISE_BELOW * e->length[p]) {
            for (int j = 0; j < r; j++) {
                const double *before = e->basis[e->order[j]];
                double share = dot(before, pivot, width);
                e->triangle[p][j] += share;
                add_multiple(pivot, -share, before, width);
            }
            square = dot(pivot, pivot, width);
        }
        if (!(square > RANK_TOLERANCE * RANK_TOLERANCE * e->length[p]))
            return r;
        double length = sqrt(square);
        e->triangle[p][r] = length;
        for (int k = 0; k < width; k++)
            pivot[k] /= length;
        for (int s = r + 1; s < count; s++) {
            int i = e->order[s];
            double share = dot(pivot, e->basis[i], width);
            e->triangle[i][r] = share;
            add_multiple(e->basis[i], -share, pivot, width);
            e->left[i] -= share * share;
            if (e->left[i] < RECOMPUTE_BELOW * e->length[i])
                e->left[i] = dot(e->basis[i], e->basis[i], width);
        }
    }
    return count;
}

/* L coefficient = b forwards, then L^T multiplier = coefficient backwards. */
static void solve_full_rank(Engine *e, int count)
{
    for (int r = 0; r < count; r++) {
        const double *row = e->triangle[e->order[r]];
        double value = e->right_side[e->order[r]];
        for (int j = 0; j < r; j++)
            value -= row[j] * e->coefficient[j];
        e->coefficient[r] = value / row[r];
    }
    for (int r = count - 1; r >= 0; r--) {
        double value = e->coefficient[r];
        for (int s = r + 1; s < count; s++) {
            int q = e->order[s];
            value -= e->triangle[q][r] * e->multiplier[q];
        }
        e->multiplier[e->order[r]] = value / e->triangle[e->order[r]][r];
    }
}

/* L = U R by columns; coefficient = R^-1 U^T b, multiplier = U R^-T coefficient. */
static void solve_deficient(Engine *e, int count, int rank)
{
    double(*u)[MAX_ROWS] = e->column_basis, (*triangle)[MAX_ROWS] = e->column_triangle;
    for (int r = 0; r < rank; r++) {
        for (int i = 0; i < count; i++)
            u[r][i] = e->triangle[i][r];
        for (int i = 0; i < r; i++) {
            u[r][e->order[i]] = 0.0;
            triangle[i][r] = 0.0;
        }
        for (int twice = 0; twice < 2; twice++)
            for (int j = 0; j < r; j++) {
                double share = dot(u[j], u[r], count);
                triangle[j][r] += share;
                add_multiple(u[r], -share, u[j], count);
            }
        triangle[r][r] = sqrt(dot(u[r], u[r], count));
        for (int i = 0; i < count; i++)
            u[r][i] /= triangle[r][r];
    }
    for (int r = 0; r < rank; r++)
        e->coefficient[r] = dot(u[r], e->right_side, count);
    for (int r = rank - 1; r >= 0; r--) {
        for (int s = r + 1; s < rank; s++)
            e->coefficient[r] -= triangle[r][s] * e->coefficient[s];
        e->coefficient[r] /= triangle[r][r];
    }
    memset(e->multiplier, 0, count * sizeof(double));
    for (int r = 0; r < rank; r++) {
        double value = e->coefficient[r];
        for (int j = 0; j < r; j++)
            value -= triangle[j][r] * e->dual[j];
        e->dual[r] = value / triangle[r][r];
        add_multiple(e->multiplier, e->dual[r], u[r], count);
    }
}

static void minimum_norm(Engine *e, int count)
{
    int width = e->coordinates;
    int rank = orthogonalise(e, count, width);
    if (rank == count)
        solve_full_rank(e, count);
    else
        solve_deficient(e, count, rank);
    memset(e->solution, 0, width * sizeof(double));
    for (int r = 0; r < rank; r++)
        add_multiple(e->solution, e->coefficient[r], e->basis[e->order[r]], width);
}

/* D = Phi_q M^-1/2, eq (2). */
static void scale_rows(Engine *e, int count)
{
    for (int r = 0; r < count; r++)
        for (int k = 0; k < e->coordinates; k++)
            e->scaled[r][k] = e->jacobian[r][k] * e->mechanism.inverse_root_mass[k];
}

/* ---- acceleration, eqs (2) and (3) ---- */

/* Difference of two entries; the ground's is zero. */
static double relative(const double *values, int on, int against, int n)
{
    return (on < n ? values[on] : 0.0) - (against < n ? values[against] : 0.0);
}

/* Write the generalised forces F; add the powers given and lost. */
static void apply_forces(Engine *e, const double *y, double *given, double *lost)
{
    int n = e->coordinates;
    const double *rates = y + n;
    memset(e->force, 0, sizeof e->force);
    for (int f = 0; f < e->mechanism.forces; f++) {
        const Force *force = &e->mechanism.force[f];
        const double *data = force->data;
        int on = 3 * force->body + 2, against = 3 * force->reaction + 2;
        double rate = relative(rates, on, against, n), torque = data[0];
        switch (force->kind) {
        case TORSION_SPRING:
            torque = -(data[0] * (relative(y, on, against, n) - data[1]) + data[2]);
            *given -= data[2] * rate;
            break;
        case DAMPER:
            torque = -data[0] * rate;
            *lost -= torque * rate;
            break;
        case SHAFT:
            torque = data[0] * (data[2] - relative(y, on, against, n)) + data[1] * (data[3] - rate);
            *given += torque * rate;
            break;
        default:
            *given += torque * rate;
        }
        e->force[on] += torque;
        e->force[against] -= torque;
    }
}

/* dy = (qd, qdd, powers) with qdd = qdd_f + M^-1/2 D^+ (gamma - Phi_q qdd_f), gamma with Baumgarte's terms. */
static void derivative(Engine *e, const double *y, double *dy)
{
    const Mechanism *m = &e->mechanism;
    int n = e->coordinates;
    place_bodies(e, y);
    int count = active_rows(e);
    double given = 0.0, lost = 0.0;
    apply_forces(e, y, &given, &lost);
    for (int k = 0; k < n; k++)
        e->free_acceleration[k] = m->inverse_mass[k] * e->force[k];
    scale_rows(e, count);
    for (int r = 0; r < count; r++) {
        double right = e->gamma[r] - (2.0 * m->alpha * e->residual_rate[r] + m->beta * m->beta * e->residual[r]);
        for (int k = 0; k < n; k++)
            right -= e->jacobian[r][k] * e->free_acceleration[k];
        e->right_side[r] = right;
    }
    minimum_norm(e, count);
    for (int k = 0; k < n; k++) {
        dy[k] = y[n + k];
        dy[n + k] = e->free_acceleration[k] + m->inverse_root_mass[k] * e->solution[k];
    }
    dy[2 * n] = given;
    dy[2 * n + 1] = lost;
}

static int row_count(const Engine *e)
{
    int count = e->joint_rows;
    for (int c = 0; c < e->mechanism.contacts; c++)
        count += e->state.mode[c].closed;
    return count;
}

/* A closed contact's force over the tolerance (least force, share of the largest one); it opens below -2. */
static double push_ratio(const Engine *e, int contact)
{
    return e->multiplier[e->row[contact]] / (1e-9 + 1e-11 * largest(e->multiplier, row_count(e)));
}

/* ---- Dormand-Prince 5(4) (Hairer, Nørsett, Wanner: Solving ODEs I, II.4 to II.6) ---- */

#define A21 (1.0 / 5)
#define A31 (3.0 / 40)
#define A32 (9.0 / 40)
#define A41 (44.0 / 45)
#define A42 (-56.0 / 15)
#define A43 (32.0 / 9)
#define A51 (19372.0 / 6561)
#define A52 (-25360.0 / 2187)
#define A53 (64448.0 / 6561)
#define A54 (-212.0 / 729)
#define A61 (9017.0 / 3168)
#define A62 (-355.0 / 33)
#define A63 (46732.0 / 5247)
#define A64 (49.0 / 176)
#define A65 (-5103.0 / 18656)
#define B1 (35.0 / 384)
#define B3 (500.0 / 1113)
#define B4 (125.0 / 192)
#define B5 (-2187.0 / 6784)
#define B6 (11.0 / 84)
#define E1 (71.0 / 57600)
#define E3 (-71.0 / 16695)
#define E4 (71.0 / 1920)
#define E5 (-17253.0 / 339200)
#define E6 (22.0 / 525)
#define E7 (-1.0 / 40)
#define D1 (-12715105075.0 / 11282082432)
#define D3 (87487479700.0 / 32700410799)
#define D4 (-10690763975.0 / 1880347072)
#define D5 (701980252875.0 / 199316789632)
#define D6 (-1453857185.0 / 822651844)
#define D7 (69997945.0 / 29380423)

static const double ABSOLUTE_FRACTION = 1e-3; /* absolute tolerance over the relative one */

static void note_pushes(Engine *e)
{
    for (int c = 0; c < e->mechanism.contacts; c++)
        if (e->state.mode[c].closed) {
            double ratio = push_ratio(e, c);
            e->least_push[c] = ratio < e->least_push[c] ? ratio : e->least_push[c];
        }
}

/* Derivative at y_stage or y_new, and what it says about the contacts. */
static void stage(Engine *e, const double *y, double *k)
{
    derivative(e, y, k);
    note_pushes(e);
}

static double square_of(double x) { return x * x; }

/* One step from y_start with k[0] there: y_new, all k, new_dense, least_push; return the error norm (<= 1: good). */
static double try_step(Engine *e, double h)
{
    int n = e->unknowns;
    const double *y = e->y_start, *k0 = e->k[0], *k1 = e->k[1], *k2 = e->k[2], *k3 = e->k[3], *k4 = e->k[4],
                 *k5 = e->k[5], *k6 = e->k[6];
    double *restrict to = e->y_stage;
    memset(e->least_push, 0, sizeof e->least_push);
    for (int i = 0; i < n; i++)
        to[i] = y[i] + h * A21 * k0[i];
    stage(e, to, e->k[1]);
    for (int i = 0; i < n; i++)
        to[i] = y[i] + h * (A31 * k0[i] + A32 * k1[i]);
    stage(e, to, e->k[2]);
    for (int i = 0; i < n; i++)
        to[i] = y[i] + h * (A41 * k0[i] + A42 * k1[i] + A43 * k2[i]);
    stage(e, to, e->k[3]);
    for (int i = 0; i < n; i++)
        to[i] = y[i] + h * (A51 * k0[i] + A52 * k1[i] + A53 * k2[i] + A54 * k3[i]);
    stage(e, to, e->k[4]);
    for (int i = 0; i < n; i++)
        to[i] = y[i] + h * (A61 * k0[i] + A62 * k1[i] + A63 * k2[i] + A64 * k3[i] + A65 * k4[i]);
    stage(e, to, e->k[5]);
    double *restrict y_new = e->y_new;
    for (int i = 0; i < n; i++)
        y_new[i] = y[i] + h * (B1 * k0[i] + B3 * k2[i] + B4 * k3[i] + B5 * k4[i] + B6 * k5[i]);
    stage(e, y_new, e->k[6]);
    double total = 0.0;
    for (int i = 0; i < n; i++) {
        double change = y_new[i] - y[i], bend = h * k0[i] - change;
        e->new_dense[0][i] = y[i];
        e->new_dense[1][i] = change;
        e->new_dense[2][i] = bend;
        e->new_dense[3][i] = change - h * k6[i] - bend;
        e->new_dense[4][i] = h * (D1 * k0[i] + D3 * k2[i] + D4 * k3[i] + D5 * k4[i] + D6 * k5[i] + D7 * k6[i]);
        double error = h * (E1 * k0[i] + E3 * k2[i] + E4 * k3[i] + E5 * k4[i] + E6 * k5[i] + E7 * k6[i]);
        double scale = e->mechanism.relative_tolerance * (ABSOLUTE_FRACTION + fmax(fabs(y[i]), fabs(y_new[i])));
        total += square_of(error / scale);
    }
    return sqrt(total / n);
}

/* y at `fraction` of the step whose coefficients are `dense`. */
static void interpolate(double (*dense)[MAX_UNKNOWNS], double fraction, double *y, int n)
{
    double rest = 1.0 - fraction;
    for (int i = 0; i < n; i++)
        y[i] = dense[0][i] +
               fraction * (dense[1][i] + rest * (dense[2][i] + fraction * (dense[3][i] + rest * dense[4][i])));
}

/* A first step size from y_end and dy_end. */
static double initial_step_size(Engine *e)
{
    int n = e->unknowns;
    const double *y = e->state.y_end, *dy = e->state.dy_end;
    double scale[MAX_UNKNOWNS], size_y = 0.0, size_dy = 0.0, bend = 0.0, first = 1e-6;
    for (int i = 0; i < n; i++) {
        scale[i] = e->mechanism.relative_tolerance * (ABSOLUTE_FRACTION + fabs(y[i]));
        size_y += square_of(y[i] / scale[i]);
        size_dy += square_of(dy[i] / scale[i]);
    }
    size_y = sqrt(size_y / n);
    size_dy = sqrt(size_dy / n);
    if (size_y > 1e-5 && size_dy > 1e-5)
        first = 0.01 * size_y / size_dy;
    for (int i = 0; i < n; i++)
        e->y_stage[i] = y[i] + first * dy[i];
    derivative(e, e->y_stage, e->dy_at);
    for (int i = 0; i < n; i++)
        bend += square_of((e->dy_at[i] - dy[i]) / scale[i]);
    bend = sqrt(bend / n) / first;
    double steepest = fmax(size_dy, bend), second = fmax(1e-6, first * 1e-3);
    if (steepest > 1e-15)
        second = pow(0.01 / steepest, 0.2);
    return fmin(100.0 * first, second);
}

/* ---- where inside a step the first event happens ---- */

enum { LOOKS = 8, BISECTIONS = 60, FORCE_BISECTIONS = 36, NEWTON_STEPS = 12, PULL_BISECTIONS = 50 };

static const double RESTS_BELOW = 1e-9, GAP_NOISE = 1e-12, ROOT_TOLERANCE = 1e-13;
static const double OPENS = -2.0;       /* push_ratio */
static const double PULLS_BELOW = -1e-9; /* N */

typedef struct { /* a gap that is watched over a step */
    int contact;
    bool armed;
    double floor;
    Gap now, next;
} Watch;

static Gap gap_at(Engine *e, int contact, double fraction)
{
    interpolate(e->new_dense, fraction, e->y_at, e->unknowns);
    place_bodies(e, e->y_at);
    return gap(e, contact);
}

/* The fraction at which a gap, above `floor` at `before` and not at `after`, comes down to it. */
static double bisect(Engine *e, int contact, double before, double after, double floor)
{
    for (int b = 0; b < BISECTIONS; b++) {
        double middle = 0.5 * (before + after);
        if (middle <= before || middle >= after)
            break;
        if (gap_at(e, contact, middle).value > floor)
            before = middle;
        else
            after = middle;
    }
    return after;
}

/* The fraction at which a gap that falls at `before` and rises at `after` is least. */
static double bottom(Engine *e, int contact, double before, double after)
{
    for (int b = 0; b < BISECTIONS; b++) {
        double middle = 0.5 * (before + after);
        if (gap_at(e, contact, middle).rate < 0.0)
            before = middle;
        else
            after = middle;
    }
    return after;
}

/* A fraction before `after` at which a gap that opens from zero is positive; 0.0 when rounding hides it. */
static double after_opening(Engine *e, int contact, double after)
{
    double fraction = after;
    for (int b = 0; b < BISECTIONS; b++) {
        fraction *= 0.5;
        if (gap_at(e, contact, fraction).value > 0.0)
            return fraction;
    }
    return 0.0;
}

/* Note a gap at the step's start; true when it fires right there. */
static bool begin_watch(Engine *e, Watch *w, int contact)
{
    w->contact = contact;
    w->now = gap(e, contact);
    w->armed = true;
    w->floor = 0.0;
    if (w->now.value > 0.0 && !e->state.mode[contact].touching)
        return false;
    if (w->now.rate < -RESTS_BELOW)
        return true;
    w->floor = -GAP_NOISE;
    if (w->now.rate > RESTS_BELOW) {
        w->armed = false;
        w->floor += fmin(w->now.value, 0.0);
    }
    return w->now.value <= w->floor;
}

/* Where between two looks a gap reaches zero; 2.0 when it does not. */
static double zero_between(Engine *e, Watch *w, double before, double after)
{
    int contact = w->contact;
    Gap next = w->next;
    double fraction = 2.0;
    if (!w->armed) {
        if (next.value <= 0.0 && (next.rate <= 0.0 || next.value < w->floor)) {
            double open = after_opening(e, contact, after);
            if (open > 0.0)
                fraction = bisect(e, contact, open, after, 0.0);
            else if (next.value <= w->floor)
                fraction = bisect(e, contact, open, after, w->floor);
        }
    } else if (next.value <= w->floor) {
        fraction = bisect(e, contact, before, after, w->floor);
    } else if (w->now.rate < 0.0 && 0.0 < next.rate && w->floor == 0.0) {
        double least = bottom(e, contact, before, after);
        if (gap_at(e, contact, least).value <= 0.0)
            fraction = bisect(e, contact, before, least, w->floor);
    }
    if (next.value > 0.0 && !w->armed) {
        w->armed = true;
        w->floor = 0.0;
    }
    if (next.value > GAP_NOISE)
        w->floor = 0.0;
    w->now = next;
    return fraction;
}

typedef struct {
    int guard, contact;
    double fraction;
} Event;

/* The first open contact whose gap reaches zero. */
static Event first_zero(Engine *e)
{
    Event none = {GUARD_NONE, -1, 2.0}, found = none;
    Watch watch[MAX_CONTACTS];
    int count = 0;
    interpolate(e->new_dense, 0.0, e->y_at, e->unknowns);
    place_bodies(e, e->y_at);
    for (int c = 0; c < e->mechanism.contacts; c++) {
        if (e->state.mode[c].closed)
            continue;
        if (begin_watch(e, &watch[count++], c))
            return (Event){GUARD_GAP, c, 0.0};
    }
    if (count == 0)
        return none;
    double before = 0.0;
    for (int look = 1; look <= LOOKS; look++) {
        double after = (double)look / LOOKS;
        interpolate(e->new_dense, after, e->y_at, e->unknowns);
        place_bodies(e, e->y_at);
        for (Watch *w = watch; w < watch + count; w++)
            w->next = gap(e, w->contact);
        for (Watch *w = watch; w < watch + count; w++) {
            double fraction = zero_between(e, w, before, after);
            if (fraction < found.fraction)
                found = (Event){GUARD_GAP, w->contact, fraction};
        }
        if (found.guard != GUARD_NONE)
            return found;
        before = after;
    }
    return none;
}

static double push_at(Engine *e, int contact, double fraction)
{
    interpolate(e->new_dense, fraction, e->y_at, e->unknowns);
    derivative(e, e->y_at, e->dy_at);
    return push_ratio(e, contact);
}

/* Where before `latest` a contact's force falls to its limit; 2.0 when the dense output shows no pull there. */
static double first_pull(Engine *e, int contact, double latest)
{
    double before = 0.0;
    for (int look = 1; look <= LOOKS; look++) {
        double after = fmin(latest, (double)look / LOOKS);
        if (push_at(e, contact, after) < OPENS) {
            for (int b = 0; b < FORCE_BISECTIONS; b++) {
                double middle = 0.5 * (before + after);
                if (push_at(e, contact, middle) < OPENS)
                    after = middle;
                else
                    before = middle;
            }
            return after;
        }
        if (after >= latest)
            return 2.0;
        before = after;
    }
    return 2.0;
}

static Event first_event(Engine *e)
{
    Event event = first_zero(e);
    for (int c = 0; c < e->mechanism.contacts; c++)
        if (e->state.mode[c].closed && !e->mechanism.contact[c].guided && e->least_push[c] < OPENS) {
            double lets_go = first_pull(e, c, event.fraction);
            if (lets_go < event.fraction)
                event = (Event){GUARD_PUSH, c, lets_go};
        }
    return event;
}

/* The step size at which the true step, not its interpolant, ends at zero gap; that step is the last one tried. */
static double refine(Engine *e, int contact, double step)
{
    double limit = 2.0 * step;
    for (int newton = 0; newton < NEWTON_STEPS; newton++) {
        try_step(e, step);
        place_bodies(e, e->y_new);
        Gap g = gap(e, contact);
        if (!(g.rate < 0.0))
            return step;
        double move = -g.value / g.rate;
        if (fabs(move) <= ROOT_TOLERANCE || !(0.0 < step + move && step + move < limit))
            return step;
        step += move;
    }
    try_step(e, step);
    return step;
}

/* Note `time` for every guided contact that pulls for the first time, by the multipliers of the last acceleration. */
static void watch_at(Engine *e, double time)
{
    for (int c = 0; c < e->mechanism.contacts; c++) {
        Mode *mode = &e->state.mode[c];
        if (mode->closed && e->mechanism.contact[c].guided && e->multiplier[e->row[c]] < PULLS_BELOW &&
            mode->pull_time == INFINITY) {
            mode->pull_time = time;
            e->state.pulls++;
        }
    }
}

/* The same after a step, located inside it by bisection. */
static void watch_step(Engine *e)
{
    State *s = &e->state;
    watch_at(e, s->step_end);
    for (int c = 0; c < e->mechanism.contacts; c++) {
        if (!s->mode[c].closed || s->mode[c].pull_time != s->step_end)
            continue;
        double before = 0.0, after = 1.0;
        for (int b = 0; b < PULL_BISECTIONS; b++) {
            double middle = 0.5 * (before + after);
            interpolate(s->dense, middle, e->y_at, e->unknowns);
            derivative(e, e->y_at, e->dy_at);
            if (e->multiplier[e->row[c]] < PULLS_BELOW)
                after = middle;
            else
                before = middle;
        }
        s->mode[c].pull_time = s->step_start + after * s->step_size;
    }
}

/* ---- drift, impact ---- */

static const double MOST_DRIFT = 1e-11, MOST_RATE_DRIFT = 1e-10, LEAST_DRIFT = 1e-14;
static const double TOUCHES_WITHIN = 1e-9, STICK_SPEED = 1e-6;
enum { MOST_ROUNDS = 40, PLASTIC_FROM = 32 };

/* values += -M^-1/2 D^+ left */
static void correct(Engine *e, int count, const double *left, double *values)
{
    scale_rows(e, count);
    for (int r = 0; r < count; r++)
        e->right_side[r] = -left[r];
    minimum_norm(e, count);
    for (int k = 0; k < e->coordinates; k++)
        values[k] += e->mechanism.inverse_root_mass[k] * e->solution[k];
}

/* Close the active rows at y_end when one is off by more than `most`, or its rate; whether anything was moved. */
static bool mend(Engine *e, double most, double most_rate)
{
    double *y = e->state.y_end;
    bool moved = false;
    place_bodies(e, y);
    int count = active_rows(e);
    if (largest(e->residual, count) > most) {
        correct(e, count, e->residual, y);
        place_bodies(e, y);
        active_rows(e);
        moved = true;
    }
    if (moved || largest(e->residual_rate, count) > most_rate) {
        correct(e, count, e->residual_rate, y + e->coordinates);
        moved = true;
    }
    return moved;
}

static double kinetic_energy(const Engine *e, const double *rate)
{
    double energy = 0.0;
    for (int k = 0; k < e->coordinates; k++)
        energy += 0.5 * rate[k] * rate[k] / e->mechanism.inverse_mass[k];
    return energy;
}

/* One round of impacts of guided contacts at y_end, eqs (4), (6), (7); whether any contact approached. */
static bool strike(Engine *e, int struck, bool plastic)
{
    State *s = &e->state;
    int n = e->coordinates, contacts = e->mechanism.contacts;
    double target[MAX_CONTACTS] = {0.0}, *rate = s->y_end + n;
    bool approached = false;
    place_bodies(e, s->y_end);
    for (int c = 0; c < contacts; c++) {
        e->closing[c] = 0.0;
        if (s->mode[c].closed)
            continue;
        Gap g = gap(e, c);
        bool touches = c == struck || g.value <= TOUCHES_WITHIN;
        if (!touches || !(g.rate < -RESTS_BELOW || (c == struck && g.rate < 0.0)))
            continue;
        double restitution = e->mechanism.contact[c].restitution;
        approached = true;
        e->closing[c] = -g.rate;
        target[c] = -g.rate;
        if (!plastic && restitution * -g.rate >= STICK_SPEED)
            target[c] = (1.0 + restitution) * -g.rate;
    }
    if (!approached)
        return false;
    for (int c = 0; c < contacts; c++)
        s->mode[c].closed = s->mode[c].closed || e->closing[c] > 0.0;
    int count = active_rows(e);
    scale_rows(e, count);
    memset(e->right_side, 0, sizeof e->right_side);
    for (int c = 0; c < contacts; c++)
        if (s->mode[c].closed)
            e->right_side[e->row[c]] = target[c];
    minimum_norm(e, count);
    for (int k = 0; k < n; k++)
        rate[k] += e->mechanism.inverse_root_mass[k] * e->solution[k];
    place_bodies(e, s->y_end);
    for (int c = 0; c < contacts; c++)
        if (e->closing[c] > 0.0) {
            s->last_impact = (Impact){s->step_end, c, e->closing[c], e->multiplier[e->row[c]]};
            s->impacts++;
            if (!(gap(e, c).rate < STICK_SPEED)) {
                s->mode[c].closed = false;
                s->mode[c].touching = true;
            }
        }
    return true;
}

/* Let an event happen at y_end: impacts until nothing approaches, then mending. */
static int transit(Engine *e, int guard, int contact)
{
    double *rate = e->state.y_end + e->coordinates;
    double energy = kinetic_energy(e, rate);
    if (guard == GUARD_PUSH) {
        e->state.mode[contact].closed = false;
        e->state.mode[contact].touching = true;
    }
    int struck = guard == GUARD_GAP ? contact : -1;
    int round = 0;
    while (round < MOST_ROUNDS && strike(e, struck, round >= PLASTIC_FROM)) {
        struck = -1;
        round++;
    }
    if (round == MOST_ROUNDS)
        return CHATTERING;
    mend(e, LEAST_DRIFT, 0.0);
    e->state.lost += energy - kinetic_energy(e, rate);
    return OK;
}

/* ---- time stepping: steps of the engine's own, which may be ahead of the time that the outside has reached ---- */

static const double SMALLEST_STEP = 1e-15; /* as a fraction of max(1 s, |t|) */
static const double MOST_TURN = 1.0;       /* of a body in a step [rad], where there are contacts */
static const double SAFETY = 0.9, SHRINK_MOST = 0.2, GROW_MOST = 5.0;
enum { MOST_STEPS = 200000 };

static void copy(const Engine *e, const double *from, double *to) { memcpy(to, from, e->unknowns * sizeof(double)); }

/* Factor for the next step size (order 5). */
static double scale_of(double error, double most)
{
    if (error == 0.0)
        return most;
    if (!(error < INFINITY))
        return SHRINK_MOST;
    return fmin(most, fmax(SHRINK_MOST, SAFETY * pow(error, -0.2)));
}

/* The step whose end is a floating-point number: late on the clock, rounding would add up. */
static double representable(double start, double step) { return (start + step) - start; }

/* Try a step; return its error, or how much too far a body turns if that shortens the step more. */
static double try_and_turn(Engine *e, double step)
{
    double error = try_step(e, step), turn = 0.0;
    if (e->mechanism.contacts == 0)
        return error;
    for (int k = 2; k < e->coordinates; k += 3)
        turn = fmax(turn, fabs(e->y_new[k] - e->y_start[k]));
    double too_far = pow(turn / MOST_TURN, 5.0); /* scale_of takes the fifth root */
    return too_far > error ? too_far : error;
}

/* Contacts that touched at the step's start have come off by y_end, but for the one that strikes there. */
static void release(Engine *e, int struck)
{
    place_bodies(e, e->state.y_end);
    for (int c = 0; c < e->mechanism.contacts; c++) {
        Mode *mode = &e->state.mode[c];
        if (mode->touching && !mode->closed && c != struck && gap(e, c).value > GAP_NOISE)
            mode->touching = false;
    }
}

/* Begin anew from y_end at step_end: nothing lies ahead. */
static void restart(Engine *e)
{
    State *s = &e->state;
    s->step_start = s->step_end;
    s->step_size = 0.0;
    s->pending_guard = GUARD_NONE;
    derivative(e, s->y_end, s->dy_end);
    watch_at(e, s->step_end);
}

/* One accepted step from step_end on, cut at the first event, which then waits. */
static int take_step(Engine *e)
{
    State *s = &e->state;
    double start = s->step_end, smallest = SMALLEST_STEP * fmax(1.0, fabs(start));
    copy(e, s->y_end, e->y_start);
    copy(e, s->dy_end, e->k[0]);
    double step = representable(start, s->next_step), grow_most = GROW_MOST;
    double error = try_and_turn(e, step);
    while (!(error <= 1.0)) {
        step = representable(start, step * scale_of(error, 1.0));
        grow_most = 1.0;
        if (!(step > smallest))
            return STEP_TOO_SMALL;
        error = try_and_turn(e, step);
    }
    s->next_step = step * scale_of(error, grow_most);

    Event event = first_event(e);
    s->pending_guard = event.guard;
    s->pending_contact = event.contact;
    if (event.guard != GUARD_NONE) {
        step *= event.fraction;
        if (!(step > smallest))
            return OK;
        if (event.guard == GUARD_GAP)
            step = refine(e, event.contact, step);
        else
            try_step(e, step);
    }
    s->steps++;
    s->step_start = start;
    s->step_size = step;
    s->step_end = start + step;
    copy(e, e->y_new, s->y_end);
    copy(e, e->k[6], s->dy_end);
    for (int r = 0; r < 5; r++)
        copy(e, e->new_dense[r], s->dense[r]);
    watch_step(e);
    release(e, event.guard == GUARD_GAP ? event.contact : -1);
    if (mend(e, MOST_DRIFT, MOST_RATE_DRIFT))
        derivative(e, s->y_end, s->dy_end);
    return OK;
}

static bool inputs_changed(const Engine *e)
{
    for (int k = 0; k < e->mechanism.inputs; k++)
        if (e->state.input[k] != e->state.held_input[k])
            return true;
    return false;
}

static void feed(Engine *e, const double *values)
{
    for (int k = 0; k < e->mechanism.inputs; k++)
        e->mechanism.force[e->mechanism.input[k].force].data[e->mechanism.input[k].column] = values[k];
}

/* Drop what lies ahead, because the inputs have changed: a true step back with the inputs that were held. */
static void resume(Engine *e)
{
    State *s = &e->state;
    if (s->time < s->step_end) {
        copy(e, s->dense[0], e->y_start);
        derivative(e, e->y_start, e->k[0]);
        try_step(e, s->time - s->step_start);
        copy(e, e->y_new, s->y_end);
        release(e, -1);
        s->step_end = s->time;
    }
    for (int c = 0; c < e->mechanism.contacts; c++)
        if (s->time < s->mode[c].pull_time && s->mode[c].pull_time < INFINITY) {
            s->mode[c].pull_time = INFINITY;
            s->pulls--;
        }
    memcpy(s->held_input, s->input, sizeof s->input);
    feed(e, s->held_input);
    restart(e);
}

/* Go on to `target` [s]. */
static int advance(Engine *e, double target)
{
    State *s = &e->state;
    feed(e, s->held_input); /* a restored state brings its own */
    if (inputs_changed(e))
        resume(e);
    for (int k = 0; k < MOST_STEPS; k++) {
        if (s->time >= s->step_end) {
            if (s->time >= target)
                return OK;
            int outcome = take_step(e);
            if (outcome != OK)
                return outcome;
        }
        if (s->step_end > target) {
            s->time = target;
            return OK;
        }
        s->time = s->step_end;
        if (s->pending_guard != GUARD_NONE) {
            int outcome = transit(e, s->pending_guard, s->pending_contact);
            if (outcome != OK)
                return outcome;
            restart(e);
            s->next_step = initial_step_size(e);
        }
    }
    return TOO_MANY_STEPS;
}

/* ---- what Python calls ---- */

size_t engine_size(void) { return sizeof(Engine); }
size_t engine_state_size(void) { return sizeof(State); }
size_t engine_mechanism_size(void) { return sizeof(Mechanism); }
State *engine_state(Engine *e) { return &e->state; }
int engine_steps(const Engine *e) { return e->state.steps; }
double engine_impact_time(const Engine *e) { return e->state.last_impact.time; }

/* Begin at time 0 from the assembled position `q`, with all rates zero; `closed` says which contacts are. */
void engine_begin(Engine *e, const Mechanism *mechanism, const double *q, const int *closed)
{
    memset(e, 0, sizeof *e);
    e->mechanism = *mechanism;
    e->coordinates = 3 * mechanism->bodies;
    e->unknowns = 2 * e->coordinates + 2;
    e->joint_rows = 2 * mechanism->pins;
    e->frame[mechanism->bodies].cosine = 1.0;
    memcpy(e->state.y_end, q, e->coordinates * sizeof(double));
    for (int c = 0; c < mechanism->contacts; c++)
        e->state.mode[c] = (Mode){closed[c], false, INFINITY};
    for (int k = 0; k < mechanism->inputs; k++)
        e->state.input[k] = mechanism->force[mechanism->input[k].force].data[mechanism->input[k].column];
    memcpy(e->state.held_input, e->state.input, sizeof e->state.input);
    restart(e);
    e->state.next_step = initial_step_size(e);
}

/* Make `count` communication steps of `step` [s], the first of them to the end of number `first`, with the two `values`
 * of input 0 in turns; return a status. */
int engine_run(Engine *e, const double values[2], double step, int first, int count)
{
    for (int k = first; k < first + count; k++) {
        e->state.input[0] = values[k % 2];
        int outcome = advance(e, k * step);
        if (outcome != OK)
            return outcome;
    }
    return OK;
}

/* The same with another engine: `advance` of its library, the place of its input in its block. */
int other_run(int64_t (*other_advance)(double *, int64_t, double), double *block, int64_t words, int64_t input,
              const double values[2], double step, int first, int count)
{
    for (int k = first; k < first + count; k++) {
        block[input] = values[k % 2];
        int outcome = (int)other_advance(block, words, k * step);
        if (outcome != OK)
            return outcome;
    }
    return OK;
}

/* y at the time reached. */
void engine_read(Engine *e, double *y)
{
    State *s = &e->state;
    if (s->time < s->step_end)
        interpolate(s->dense, (s->time - s->step_start) / s->step_size, y, e->unknowns);
    else
        copy(e, s->y_end, y);
}

/* Evaluate the derivative `count` times, as the integrator does. */
void engine_derivatives(Engine *e, const double *y, double *dy, int count)
{
    for (int k = 0; k < count; k++)
        derivative(e, y, dy);
}
