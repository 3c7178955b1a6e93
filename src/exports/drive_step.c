/* A contact that closes, opens or slips does so at its own instant, not at a step: between events the drive is
   linear and is followed by its Taylor series, and each event is found as the root of a polynomial. Smooth torques
   are quadratics along the motion. Everything is in SI; no allocation, no global state, no library but math.h. */

#define GSD_ORDER 14 /* of the series */
#define GSD_MODES 12 /* contact or none, load and motor that slip or stick, and in which direction the motor goes */

typedef struct {
  double dt;                    /* step [s] */
  double km, m1, m2;            /* torque per unit of u; inertias [kg m2] */
  double d1_plus, d1_minus, d2; /* viscous damping by direction, of the load [N m s/rad] */
  double f1_plus, f1_minus, f2; /* dry friction by direction, of the load [N m] */
  double load_torque;           /* [N m] */
  double half_gap, k, c;        /* contact [rad, N m/rad, N m s/rad] */
  double adhesion;              /* tensile torque at which it parts [N m] */
  double delay, lag;            /* of the input [s] */
  double knee, sharpness;       /* of its saturation; knee 0: none */
  double dead_zone;
  double cogging, cogging_n, cogging_phase, cogging_s2, cogging_c2, cogging_s3, cogging_c3;
  double ripple, ripple_n, ripple_phase, ripple_s2, ripple_c2, ripple_s3, ripple_c3;
  double unbalance, unbalance_phase, unbalance_n;
  double drag, drag_exponent;
  double stiction, stribeck_speed, stribeck_exponent; /* level times ratio [N m] */
  double stribeck_level;
  int has_load, locked, motor_sticks, load_sticks, smooth;
} gsd_numbers;

/* What a mode does within a piece of a step, as numbers: of depth, w1, w2, torque on motor and load, and what dies
   away, to the change of x1, w1, the change of x2, and w2. */
typedef struct {
  int ready, pieces;
  double h, share;
  double to[6][4];
} gsd_map;

typedef struct {
  double x1, w1, x2, w2;                          /* [rad, rad/s]; x1 is what the encoder sees */
  int contact, outside;                           /* closed contact; open but beyond the edge: -1, 0, 1 */
  int load, motor;                                /* 0 sticks, -1 and 1 slip */
  int touching;                                   /* the side that was just left */
  int contact_zeros, load_zeros, motor_zeros;     /* of the guards, just after their event */
  double torque;                                  /* of the input [N m] */
  double lacking;                                 /* of it, behind the lag [N m] */
  double held[GSD_HELD];                          /* inputs that wait for their time */
  int newest, started;
  gsd_map maps[2][GSD_MODES]; /* of a step, or of its part before and after a held input changes */
} gsd_state;

typedef struct {
  double motor[3], load[3]; /* torques without dampers and contact, as quadratics of the time [N m] */
  double dying, rate;       /* amplitude of what dies away at the rate [N m, 1/s] */
} gsd_forcing;

typedef struct {
  int order;
  double x1[GSD_ORDER + 1], w1[GSD_ORDER + 1], x2[GSD_ORDER + 1], w2[GSD_ORDER + 1], torque[GSD_ORDER + 1];
} gsd_series;

typedef enum {
  gsd_opens,
  gsd_closes,
  gsd_inside,
  gsd_load_stops,
  gsd_load_breaks,
  gsd_motor_stops,
  gsd_motor_breaks
} gsd_event;

typedef struct {
  gsd_event event;
  int side, zeros;
  double p[GSD_ORDER + 1]; /* positive as long as the mode lasts */
} gsd_guard;

static inline int gsd_direction(double v) { return v > 0.0 ? 1 : v < 0.0 ? -1 : 0; }

static inline double gsd_level(const gsd_numbers *n, int direction) {
  return direction < 0 ? n->f1_minus : n->f1_plus;
}

static inline double gsd_command(const gsd_numbers *n, double u) {
  if (n->dead_zone > 0.0) u = u > n->dead_zone ? u - n->dead_zone : u < -n->dead_zone ? u + n->dead_zone : 0.0;
  if (n->knee > 0.0 && u != 0.0) u /= pow(1.0 + pow(fabs(u) / n->knee, n->sharpness), 1.0 / n->sharpness);
  return u;
}

/* sin y with its second and third harmonics. */
static inline double gsd_harmonics(double y, double s2, double c2, double s3, double c3) {
  return sin(y) + s2 * sin(2.0 * y) + c2 * cos(2.0 * y) + s3 * sin(3.0 * y) + c3 * cos(3.0 * y);
}

/* How much faster than sin y that changes. */
static inline double gsd_harmonics_rate(double s2, double c2, double s3, double c3) {
  return 1.0 + fabs(s2) + fabs(c2) + 2.0 * (fabs(s3) + fabs(c3));
}

/* What the smooth effects add: on the motor, on the load. */
static inline void gsd_extra(const gsd_numbers *n, const gsd_state *s, double x1, double w1, double x2,
                             double *motor, double *load) {
  const int direction = n->motor_sticks ? s->motor : gsd_direction(w1);
  *motor = *load = 0.0;
  if (n->cogging != 0.0)
    *motor -= n->cogging * gsd_harmonics(n->cogging_n * x1 + n->cogging_phase, n->cogging_s2, n->cogging_c2,
                                         n->cogging_s3, n->cogging_c3);
  if (n->ripple != 0.0)
    *motor += s->torque * n->ripple * gsd_harmonics(n->ripple_n * x1 + n->ripple_phase, n->ripple_s2, n->ripple_c2,
                                                    n->ripple_s3, n->ripple_c3);
  if (n->drag != 0.0) *motor -= n->drag * w1 * pow(w1 * w1 + 1e-12, 0.5 * (n->drag_exponent - 1.0));
  if (n->stiction != 0.0) {
    const double v = w1 / n->stribeck_speed;
    *motor += direction * n->stiction * (1.0 - exp(-pow(v * v + 1e-12, 0.5 * n->stribeck_exponent)));
  }
  if (n->unbalance != 0.0) *load -= n->unbalance * sin(n->unbalance_n * (n->has_load ? x2 : x1) + n->unbalance_phase);
  if (!n->has_load) *motor += *load;
}

/* The fastest of their rates [1/s]: pieces are short against it. */
static inline double gsd_extra_rate(const gsd_numbers *n, const gsd_state *s) {
  double rate = 0.0, other;
  if (n->cogging != 0.0) rate = fabs(n->cogging_n * s->w1) * gsd_harmonics_rate(n->cogging_s2, n->cogging_c2, n->cogging_s3, n->cogging_c3);
  other = fabs(n->ripple_n * s->w1) * gsd_harmonics_rate(n->ripple_s2, n->ripple_c2, n->ripple_s3, n->ripple_c3);
  if (n->ripple != 0.0 && other > rate) rate = other;
  other = fabs(n->unbalance_n * (n->has_load ? s->w2 : s->w1));
  if (n->unbalance != 0.0 && other > rate) rate = other;
  if (n->stiction != 0.0 && fabs(s->w1) <= 4.0 * n->stribeck_speed) {
    const double excess = 1.0 + n->stiction / n->stribeck_level;
    const double torque = fabs(s->torque) + n->stribeck_level * (excess > 1.0 ? excess : 1.0);
    other = 3.0 * torque / (n->m1 * n->stribeck_speed * n->stribeck_exponent);
    if (other > rate) rate = other;
  }
  return rate < 16.0 / n->dt ? rate : 16.0 / n->dt;
}

static inline void gsd_forcing_now(const gsd_numbers *n, const gsd_state *s, gsd_forcing *on) {
  int i;
  for (i = 0; i < 3; ++i) on->motor[i] = on->load[i] = 0.0;
  on->motor[0] = s->torque;
  if (n->motor_sticks && s->motor != 0) on->motor[0] -= s->motor * gsd_level(n, s->motor);
  on->load[0] = n->load_torque;
  if (n->load_sticks) on->load[0] -= s->load * n->f2;
  on->dying = s->lacking;
  on->rate = n->lag > 0.0 ? 1.0 / n->lag : 0.0;
}

/* The exact flow of the running mode from here on. */
static inline void gsd_flow(const gsd_numbers *n, const gsd_state *s, const gsd_forcing *on, gsd_series *z) {
  const double d1 = s->motor < 0 ? n->d1_minus : n->d1_plus;
  const double over_m1 = 1.0 / n->m1, over_m2 = 1.0 / n->m2;
  const int side = s->contact != 0 ? s->contact : s->outside;
  double dying = on->dying;
  int i;
  z->x1[0] = s->x1;
  z->w1[0] = s->w1;
  z->x2[0] = s->x2;
  z->w2[0] = s->w2;
  for (i = 0;; ++i) {
    const double next = 1.0 / (i + 1);
    double motor = i < 3 ? on->motor[i] : 0.0, load = i < 3 ? on->load[i] : 0.0;
    z->torque[i] = 0.0;
    if (side != 0) {
      const double delta = z->x1[i] - z->x2[i] - (i == 0 ? side * n->half_gap : 0.0);
      z->torque[i] = n->k * delta + n->c * (z->w1[i] - z->w2[i]);
    }
    if (i == z->order) break;
    if (on->rate > 0.0) {
      motor += dying;
      dying *= -on->rate * next;
    }
    if (s->contact != 0) {
      motor -= z->torque[i];
      load += z->torque[i];
    }
    z->x1[i + 1] = z->w1[i] * next;
    z->x2[i + 1] = z->w2[i] * next;
    z->w1[i + 1] = s->motor == 0 ? 0.0 : (motor - d1 * z->w1[i]) * over_m1 * next;
    z->w2[i + 1] = s->load == 0 ? 0.0 : (load - n->d2 * z->w2[i]) * over_m2 * next;
  }
}

static inline double gsd_value(const double *p, int order, double t) {
  double sum = p[order];
  int i;
  for (i = order - 1; i >= 0; --i) sum = sum * t + p[i];
  return sum;
}

/* Slope and curvature of the quadratic through three equally spaced values. */
static inline void gsd_bend(double *q, double start, double middle, double end, double h) {
  q[1] = (4.0 * middle - 3.0 * start - end) / h;
  q[2] = 2.0 * (start - 2.0 * middle + end) / (h * h);
}

/* The flow over h, the smooth torques as quadratics along it. */
static inline void gsd_build(const gsd_numbers *n, const gsd_state *s, double h, gsd_series *z, gsd_forcing *on) {
  double motor[3], load[3];
  int pass, i;
  gsd_forcing_now(n, s, on);
  if (n->smooth) {
    gsd_extra(n, s, s->x1, s->w1, s->x2, &motor[0], &load[0]);
    on->motor[0] += motor[0];
    if (n->has_load) on->load[0] += load[0];
  }
  gsd_flow(n, s, on, z);
  for (pass = 0; n->smooth && h > 0.0 && pass < 3; ++pass) {
    for (i = 1; i < 3; ++i) {
      const double t = 0.5 * i * h;
      gsd_extra(n, s, gsd_value(z->x1, z->order, t), gsd_value(z->w1, z->order, t), gsd_value(z->x2, z->order, t),
                &motor[i], &load[i]);
    }
    gsd_bend(on->motor, motor[0], motor[1], motor[2], h);
    if (n->has_load) gsd_bend(on->load, load[0], load[1], load[2], h);
    gsd_flow(n, s, on, z);
  }
}

static inline double gsd_motor_term(const gsd_forcing *on, int i) {
  double dying = on->rate > 0.0 ? on->dying : 0.0;
  int j;
  for (j = 1; j <= i; ++j) dying *= -on->rate / j;
  return (i < 3 ? on->motor[i] : 0.0) + dying;
}

static inline double gsd_guard_term(const gsd_numbers *n, const gsd_state *s, const gsd_series *z,
                                    const gsd_forcing *on, const gsd_guard *g, int i) {
  const double side = g->side, contact = s->contact != 0 ? z->torque[i] : 0.0;
  const double edge = i == 0 ? n->half_gap : 0.0, load = i < 3 ? on->load[i] : 0.0;
  switch (g->event) {
    case gsd_opens:
      return (i == 0 ? n->adhesion : 0.0) + side * z->torque[i];
    case gsd_closes:
      return s->outside != 0 ? -side * z->torque[i] : edge - side * (z->x1[i] - z->x2[i]);
    case gsd_inside:
      return side * (z->x1[i] - z->x2[i]) - edge;
    case gsd_load_stops:
      return side * z->w2[i];
    case gsd_load_breaks:
      return (i == 0 ? n->f2 : 0.0) - side * (load + contact);
    case gsd_motor_stops:
      return side * z->w1[i];
    case gsd_motor_breaks:
      return (i == 0 ? gsd_level(n, g->side) : 0.0) - side * (gsd_motor_term(on, i) - contact);
  }
  return 1.0;
}

static inline int gsd_add(gsd_guard *g, int count, gsd_event event, int side, int zeros) {
  g[count].event = event;
  g[count].side = side;
  g[count].zeros = zeros;
  return count + 1;
}

/* What may end the mode. */
static inline int gsd_collect(const gsd_numbers *n, const gsd_state *s, const gsd_series *z, const gsd_forcing *on,
                              gsd_guard *g) {
  int count = 0, side, i, j;
  if (n->has_load && s->contact != 0) count = gsd_add(g, count, gsd_opens, s->contact, s->contact_zeros);
  if (n->has_load && s->contact == 0 && s->outside != 0) {
    count = gsd_add(g, count, gsd_inside, s->outside, 0);
    count = gsd_add(g, count, gsd_closes, s->outside, s->contact_zeros);
  }
  for (side = 1; side >= -1; side -= 2) {
    if (n->has_load && s->contact == 0 && s->outside == 0)
      count = gsd_add(g, count, gsd_closes, side, side == s->touching ? s->contact_zeros : 0);
    if (n->load_sticks && s->load == 0 && (s->contact != 0 || n->smooth))
      count = gsd_add(g, count, gsd_load_breaks, side, 0);
    if (n->motor_sticks && s->motor == 0 && (s->contact != 0 || n->smooth || n->lag > 0.0))
      count = gsd_add(g, count, gsd_motor_breaks, side, 0);
  }
  if (n->load_sticks && s->load != 0) count = gsd_add(g, count, gsd_load_stops, s->load, s->load_zeros);
  if (n->motor_sticks && s->motor != 0) count = gsd_add(g, count, gsd_motor_stops, s->motor, s->motor_zeros);
  for (i = 0; i < count; ++i)
    for (j = 0; j <= z->order; ++j) g[i].p[j] = gsd_guard_term(n, s, z, on, &g[i], j);
  return count;
}

static inline double gsd_slope(const double *p, int order, double t) {
  double sum = 0.0;
  int i;
  for (i = order; i >= 1; --i) sum = sum * t + i * p[i];
  return sum;
}

/* Between a positive value and one that is not. */
static inline double gsd_bracketed(const double *p, int order, double low, double high) {
  double t = high, value, slope, next;
  int i;
  for (i = 0; i < 100 && high - low > 1e-16 * high; ++i) {
    value = gsd_value(p, order, t);
    slope = gsd_slope(p, order, t);
    if (value == 0.0) return t;
    if (value > 0.0)
      low = t;
    else
      high = t;
    next = slope != 0.0 ? t - value / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t) break;
    t = next;
  }
  return t;
}

/* The first root in (0, h]; a negative number where there is none. */
static inline double gsd_first_root(const double *p, int order, double h) {
  double fall = 0.0, power = h, left, value, left_slope;
  int i, j;
  for (i = 1; i <= order; ++i, power *= h)
    if (p[i] < 0.0) fall -= p[i] * power;
  if (!(p[0] < 0.0 || (fall > 0.0 && fall >= p[0]))) return -1.0;
  left = p[0] > 0.0 ? 0.0 : h / 64.0;
  if (gsd_value(p, order, left) <= 0.0) return 0.0;
  left_slope = gsd_slope(p, order, left);
  for (i = 1; i <= 4; ++i) {
    const double right = 0.25 * h * i, right_slope = gsd_slope(p, order, right);
    value = gsd_value(p, order, right);
    if (value <= 0.0) return gsd_bracketed(p, order, left, right);
    if (left_slope < 0.0 && right_slope > 0.0) {
      double low = left, high = right;
      for (j = 0; j < 48; ++j) {
        const double middle = 0.5 * (low + high);
        if (gsd_slope(p, order, middle) < 0.0)
          low = middle;
        else
          high = middle;
      }
      if (gsd_value(p, order, low) <= 0.0) return gsd_bracketed(p, order, left, low);
    }
    left = right;
    left_slope = right_slope;
  }
  return -1.0;
}

static inline double gsd_contact_torque(const gsd_numbers *n, const gsd_state *s, int side) {
  return n->k * (s->x1 - s->x2 - side * n->half_gap) + n->c * (s->w1 - s->w2);
}

static inline void gsd_applied(const gsd_numbers *n, const gsd_state *s, double *motor, double *load) {
  const double contact = s->contact != 0 ? gsd_contact_torque(n, s, s->contact) : 0.0;
  gsd_forcing on;
  double extra_motor = 0.0, extra_load = 0.0;
  gsd_forcing_now(n, s, &on);
  if (n->smooth) gsd_extra(n, s, s->x1, s->w1, s->x2, &extra_motor, &extra_load);
  *motor = gsd_motor_term(&on, 0) + extra_motor - contact;
  *load = on.load[0] + extra_load + contact;
}

/* A body at rest sticks while the torque on it is within its friction. */
static inline void gsd_resolve_load(const gsd_numbers *n, gsd_state *s) {
  double motor, load;
  if (n->locked) return;
  s->load = 0;
  gsd_applied(n, s, &motor, &load);
  if (fabs(load) > n->f2) s->load = gsd_direction(load);
  s->load_zeros = 1;
}

static inline void gsd_resolve_motor(const gsd_numbers *n, gsd_state *s) {
  double motor, load;
  int direction;
  s->motor = 0;
  gsd_applied(n, s, &motor, &load);
  direction = motor < 0.0 ? -1 : 1;
  if (fabs(motor) > gsd_level(n, direction)) s->motor = direction;
  s->motor_zeros = 1;
}

static inline void gsd_cross(const gsd_numbers *n, gsd_state *s, const gsd_guard *g) {
  switch (g->event) {
    case gsd_opens:
      s->contact = 0;
      s->outside = n->c > 0.0 && g->side * (s->x1 - s->x2) - n->half_gap > 0.0 ? g->side : 0;
      s->touching = g->side;
      s->contact_zeros = 1;
      break;
    case gsd_closes:
      s->contact_zeros = s->outside != 0 || n->c == 0.0 ? 1 : 0;
      s->contact = g->side;
      s->outside = 0;
      if (n->load_sticks && s->load == 0) gsd_resolve_load(n, s);
      if (n->motor_sticks && s->motor == 0) gsd_resolve_motor(n, s);
      break;
    case gsd_inside:
      s->outside = 0;
      s->touching = g->side;
      s->contact_zeros = 1;
      break;
    case gsd_load_stops:
      s->w2 = 0.0;
      gsd_resolve_load(n, s);
      break;
    case gsd_load_breaks:
      s->load = g->side;
      s->load_zeros = 2;
      break;
    case gsd_motor_stops:
      s->w1 = 0.0;
      gsd_resolve_motor(n, s);
      break;
    case gsd_motor_breaks:
      s->motor = g->side;
      s->motor_zeros = 2;
      break;
  }
}

static inline void gsd_accept(const gsd_numbers *n, gsd_state *s, const gsd_series *z, double t) {
  const double x1 = gsd_value(z->x1, z->order, t), w1 = gsd_value(z->w1, z->order, t);
  s->x2 = gsd_value(z->x2, z->order, t);
  s->w2 = gsd_value(z->w2, z->order, t);
  s->x1 = x1;
  s->w1 = w1;
  if (n->lag > 0.0) s->lacking *= exp(-t / n->lag);
}

static inline void gsd_forget(gsd_state *s) {
  s->contact_zeros = s->load_zeros = s->motor_zeros = s->touching = 0;
}

/* Fastest rate of the running mode [1/s]. */
static inline double gsd_rate(const gsd_numbers *n, const gsd_state *s) {
  const double inverse = 1.0 / n->m1 + 1.0 / n->m2;
  double rate = fmax(fabs(n->d1_plus), fabs(n->d1_minus)) / n->m1;
  if (n->has_load) {
    rate = fmax(rate, n->d2 / n->m2);
    if (s->contact != 0 || s->outside != 0) rate += fmax(sqrt(n->k * inverse), n->c * inverse);
  }
  return n->lag > 0.0 ? fmax(rate, 1.0 / n->lag) : rate;
}

/* Terms until the next is below 1e-17 of the state, at least 4. */
static inline int gsd_order(double reach) {
  double term = reach;
  int i = 0;
  while (i < GSD_ORDER && (term > 1e-17 || i < 4)) {
    ++i;
    term *= reach / (i + 1);
  }
  return i;
}

/* A time of constant input, through all that happens in it. */
static inline void gsd_advance(const gsd_numbers *n, gsd_state *s, double span) {
  gsd_series z;
  gsd_forcing on;
  gsd_guard guards[6];
  int count, i, first, events;
  for (events = 0; events < 10000; ++events) {
    const double rate = gsd_rate(n, s);
    double reach = (n->smooth ? 0.4 : 0.75) / rate, pieces, h, time;
    if (n->smooth) reach = fmin(reach, 0.25 / fmax(gsd_extra_rate(n, s), 1e-9));
    pieces = fmax(1.0, ceil(span / reach));
    h = span / pieces;
    z.order = gsd_order(rate * h);
    gsd_build(n, s, h, &z, &on);
    count = h > 1e-13 * n->dt ? gsd_collect(n, s, &z, &on, guards) : 0;
    first = -1;
    time = h;
    for (i = 0; i < count; ++i) {
      const int zeros = guards[i].zeros;
      const double root = gsd_first_root(guards[i].p + zeros, z.order - zeros, time);
      if (root >= 0.0 && (first < 0 || root < time)) {
        first = i;
        time = root;
      }
    }
    gsd_accept(n, s, &z, time);
    if (first < 0 || time > 1e-13 * n->dt) gsd_forget(s);
    if (first < 0) {
      if (pieces == 1.0) return;
      span -= h;
      continue;
    }
    span -= time;
    gsd_cross(n, s, &guards[first]);
  }
}

static inline const gsd_map *gsd_map_of_mode(const gsd_numbers *n, gsd_state *s, double span, int part) {
  gsd_map *map = &s->maps[part][(s->contact != 0 ? 6 : 0) + (s->load != 0 ? 3 : 0) + s->motor + 1];
  gsd_numbers plain = *n;
  int i, j;
  if (map->ready) return map;
  plain.half_gap = 0.0; /* its share is in the depth */
  map->pieces = (int)fmax(1.0, ceil(gsd_rate(n, s) * span / 0.75));
  map->h = span / map->pieces;
  map->share = n->lag > 0.0 ? exp(-map->h / n->lag) : 1.0;
  for (i = 0; i < 6; ++i) {
    gsd_state unit = *s;
    gsd_forcing on = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0.0};
    gsd_series z;
    unit.x1 = i == 0 ? 1.0 : 0.0;
    unit.w1 = i == 1 ? 1.0 : 0.0;
    unit.x2 = 0.0;
    unit.w2 = i == 2 ? 1.0 : 0.0;
    on.motor[0] = i == 3 ? 1.0 : 0.0;
    on.load[0] = i == 4 ? 1.0 : 0.0;
    on.dying = i == 5 ? 1.0 : 0.0;
    on.rate = n->lag > 0.0 ? 1.0 / n->lag : 0.0;
    z.order = GSD_ORDER;
    gsd_flow(&plain, &unit, &on, &z);
    map->to[i][0] = gsd_value(z.x1, z.order, map->h) - unit.x1;
    map->to[i][1] = gsd_value(z.w1, z.order, map->h);
    map->to[i][2] = gsd_value(z.x2, z.order, map->h);
    map->to[i][3] = gsd_value(z.w2, z.order, map->h);
    for (j = 0; j < 4; ++j)
      if (s->contact == 0 && (i == 0 || (j < 2 ? i == 2 || i == 4 : i == 1 || i == 3 || i == 5))) map->to[i][j] = 0.0;
  }
  map->ready = 1;
  return map;
}

/* Whether what is positive may fall to zero in between: by its values and slopes at both ends, h apart. A yes may be
   wrong, a no is not. */
static inline int gsd_dips(double g0, double slope0, double g1, double slope1, double h) {
  if (g1 <= 0.0) return 1;
  if (!(slope0 < 0.0 && slope1 > 0.0)) return 0;
  return g0 + slope0 * (g1 - g0 - slope1 * h) / (slope0 - slope1) <= 0.0;
}

/* What the guards look at, at one end of a piece. */
typedef struct {
  double delta, rate, torque, torque_rate, w1, a1, w2, a2, motor, motor_rate;
} gsd_end;

static inline void gsd_end_of(const gsd_numbers *n, const gsd_state *s, const double *z, double motor, double dying,
                              double load, gsd_end *e) {
  const double d1 = s->motor < 0 ? n->d1_minus : n->d1_plus;
  double contact;
  e->delta = z[0] - z[2];
  e->rate = z[1] - z[3];
  e->torque = s->contact != 0 ? n->k * (e->delta - s->contact * n->half_gap) + n->c * e->rate : 0.0;
  contact = e->torque;
  e->motor = motor + dying - contact;
  e->w1 = z[1];
  e->w2 = z[3];
  e->a1 = s->motor == 0 ? 0.0 : (e->motor - d1 * z[1]) / n->m1;
  e->a2 = s->load == 0 ? 0.0 : (load - n->d2 * z[3] + contact) / n->m2;
  e->torque_rate = s->contact != 0 ? n->k * e->rate + n->c * (e->a1 - e->a2) : 0.0;
  e->motor_rate = (n->lag > 0.0 ? -dying / n->lag : 0.0) - e->torque_rate;
}

static inline int gsd_may_break(double plus, double minus, double a0, double rate0, double a1, double rate1,
                                double h) {
  return gsd_dips(plus - a0, -rate0, plus - a1, -rate1, h) || gsd_dips(minus + a0, rate0, minus + a1, rate1, h);
}

static inline int gsd_may_leave(const gsd_numbers *n, const gsd_state *s, const gsd_end *a, const gsd_end *b,
                                double load, double h) {
  const double side = s->contact;
  if (s->contact != 0 && gsd_dips(n->adhesion + side * a->torque, side * a->torque_rate,
                                  n->adhesion + side * b->torque, side * b->torque_rate, h))
    return 1;
  if (n->has_load && s->contact == 0 &&
      (gsd_dips(n->half_gap - a->delta, -a->rate, n->half_gap - b->delta, -b->rate, h) ||
       gsd_dips(n->half_gap + a->delta, a->rate, n->half_gap + b->delta, b->rate, h)))
    return 1;
  if (n->motor_sticks && s->motor != 0 &&
      gsd_dips(s->motor * a->w1, s->motor * a->a1, s->motor * b->w1, s->motor * b->a1, h))
    return 1;
  if (n->motor_sticks && s->motor == 0 &&
      gsd_may_break(n->f1_plus, n->f1_minus, a->motor, a->motor_rate, b->motor, b->motor_rate, h))
    return 1;
  if (!n->load_sticks) return 0;
  if (s->load != 0) return gsd_dips(s->load * a->w2, s->load * a->a2, s->load * b->w2, s->load * b->a2, h);
  return s->contact != 0 && gsd_may_break(n->f2, n->f2, load + a->torque, a->torque_rate, load + b->torque,
                                          b->torque_rate, h);
}

/* A part of a step without smooth torques: piece by piece as its mode maps it, until something may happen. */
static inline void gsd_whole(const gsd_numbers *n, gsd_state *s, double span, int part) {
  const gsd_map *map;
  gsd_forcing on;
  int piece, j;
  if (s->outside != 0) {
    gsd_advance(n, s, span);
    return;
  }
  map = gsd_map_of_mode(n, s, span, part);
  gsd_forcing_now(n, s, &on);
  for (piece = 0; piece < map->pieces; ++piece) {
    const double depth = s->x1 - s->x2 - s->contact * n->half_gap, dying = n->lag > 0.0 ? s->lacking : 0.0;
    double here[4], next[4];
    gsd_end a, b;
    here[0] = s->x1;
    here[1] = s->w1;
    here[2] = s->x2;
    here[3] = s->w2;
    for (j = 0; j < 4; ++j)
      next[j] = map->to[0][j] * depth + map->to[1][j] * s->w1 + map->to[2][j] * s->w2 + map->to[3][j] * on.motor[0] +
                map->to[4][j] * on.load[0] + map->to[5][j] * dying;
    next[0] += s->x1;
    next[2] += s->x2;
    gsd_end_of(n, s, here, on.motor[0], dying, on.load[0], &a);
    gsd_end_of(n, s, next, on.motor[0], dying * map->share, on.load[0], &b);
    if (gsd_may_leave(n, s, &a, &b, on.load[0], map->h)) {
      gsd_advance(n, s, span - piece * map->h);
      return;
    }
    s->x1 = next[0];
    s->w1 = next[1];
    s->x2 = next[2];
    s->w2 = next[3];
    s->lacking *= map->share;
    gsd_forget(s);
  }
}

static inline void gsd_segment(const gsd_numbers *n, gsd_state *s, double span, int part, double u) {
  const double before = s->torque;
  s->torque = n->km * gsd_command(n, u) + (n->has_load ? 0.0 : n->load_torque);
  if (n->lag > 0.0) s->lacking += before - s->torque;
  if (s->motor == 0) gsd_resolve_motor(n, s);
  if (s->load == 0 && n->smooth && n->load_sticks) gsd_resolve_load(n, s);
  if (n->smooth)
    gsd_advance(n, s, span);
  else
    gsd_whole(n, s, span, part);
}

static inline void gsd_start_at(const gsd_numbers *n, gsd_state *s, double x1, double w1, double x2, double w2) {
  int side, i;
  s->x1 = x1;
  s->w1 = w1;
  s->x2 = x2;
  s->w2 = n->locked ? 0.0 : w2;
  s->contact = s->outside = 0;
  s->motor = n->motor_sticks ? gsd_direction(w1) : 1;
  s->load = n->locked || n->load_sticks ? gsd_direction(s->w2) : 1;
  s->torque = s->lacking = 0.0;
  s->newest = s->started = 0;
  for (i = 0; i < GSD_HELD; ++i) s->held[i] = 0.0;
  for (i = 0; i < GSD_MODES; ++i) s->maps[0][i].ready = s->maps[1][i].ready = 0;
  gsd_forget(s);
  for (side = 1; n->has_load && side >= -1; side -= 2) {
    if (side * (x1 - x2) - n->half_gap <= 0.0) continue;
    if (side * gsd_contact_torque(n, s, side) > 0.0)
      s->contact = side;
    else
      s->outside = side;
  }
  if (n->load_sticks && s->load == 0) gsd_resolve_load(n, s);
}

/* One step with the input u, held over it.  Returns x1 at its end. */
static inline double gsd_advance_by_step(const gsd_numbers *n, gsd_state *s, double u) {
  const double whole = floor(n->delay / n->dt);
  const double rest = n->delay - whole * n->dt;
  int i, older;
  if (!s->started) { /* the first input held still before the start */
    for (i = 0; i < GSD_HELD; ++i) s->held[i] = u;
    s->torque = n->km * gsd_command(n, u) + (n->has_load ? 0.0 : n->load_torque);
    s->started = 1;
  }
  s->newest = (s->newest + 1) % GSD_HELD;
  s->held[s->newest] = u;
  older = (s->newest + GSD_HELD - (int)whole % GSD_HELD) % GSD_HELD;
  if (rest > 0.0) gsd_segment(n, s, rest, 1, s->held[(older + GSD_HELD - 1) % GSD_HELD]);
  gsd_segment(n, s, n->dt - rest, 0, s->held[older]);
  return s->x1;
}
