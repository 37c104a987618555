/* Built-in functions of numbers and vectors. */
#include "io/pov_reader.h"

/* Functions of floats, their arguments at most; -1: any number from one. Those of functions { } too. */
static const struct { uint32_t word; int least, most; } maths[] = {
	{ WORD_abs, 1, 1 }, { WORD_ceil, 1, 1 }, { WORD_floor, 1, 1 }, { WORD_int, 1, 1 }, { WORD_sqrt, 1, 1 }, { WORD_exp, 1, 1 },
	{ WORD_ln, 1, 1 }, { WORD_log, 1, 1 }, { WORD_sin, 1, 1 }, { WORD_cos, 1, 1 }, { WORD_tan, 1, 1 }, { WORD_asin, 1, 1 },
	{ WORD_acos, 1, 1 }, { WORD_atan, 1, 1 }, { WORD_sinh, 1, 1 }, { WORD_cosh, 1, 1 }, { WORD_tanh, 1, 1 }, { WORD_asinh, 1, 1 },
	{ WORD_acosh, 1, 1 }, { WORD_atanh, 1, 1 }, { WORD_atan2, 2, 2 }, { WORD_degrees, 1, 1 }, { WORD_radians, 1, 1 },
	{ WORD_pow, 2, 2 }, { WORD_mod, 2, 2 }, { WORD_div, 2, 2 }, { WORD_min, 1, -1 }, { WORD_max, 1, -1 }, { WORD_sqr, 1, 1 },
	{ WORD_select, 3, 4 }, { WORD_bitwise_and, 2, 2 }, { WORD_bitwise_or, 2, 2 }, { WORD_bitwise_xor, 2, 2 },
};
enum { MATHS = sizeof maths / sizeof *maths, ARGUMENTS_MOST = 64 };

static const double degree = 3.14159265358979323846 / 180;

int pov_math_arguments(uint32_t word)
{
	if (word < WORD_abs || word > WORD_bitwise_xor)
		return -2;
	return maths[word - WORD_abs].most;
}

static double fold(uint32_t word, const double *a, int n)
{
	double x = a[0];
	for (int i = 1; i < n; i++)
		x = word == WORD_min ? (a[i] < x ? a[i] : x) : (a[i] > x ? a[i] : x);
	return x;
}

static double bitwise(uint32_t word, double x, double y)
{
	int64_t a = fabs(x) < 9e18 ? (int64_t)x : 0, b = fabs(y) < 9e18 ? (int64_t)y : 0;
	return (double)(word == WORD_bitwise_and ? a & b : word == WORD_bitwise_or ? a | b : a ^ b);
}

bool pov_math(uint32_t word, const double *a, int n, double *out)
{
	double x = a[0], y = n > 1 ? a[1] : 0, r;
	switch (word) {
	case WORD_abs: r = fabs(x); break;
	case WORD_ceil: r = ceil(x); break;
	case WORD_floor: r = floor(x); break;
	case WORD_int: r = trunc(x); break;
	case WORD_sqrt: r = x > 0 ? sqrt(x) : 0; break;
	case WORD_exp: r = exp(x); break;
	case WORD_ln: r = log(x); break;
	case WORD_log: r = log10(x); break;
	case WORD_sin: r = sin(x); break;
	case WORD_cos: r = cos(x); break;
	case WORD_tan: r = tan(x); break;
	case WORD_asin: r = asin(x > 1 ? 1 : x < -1 ? -1 : x); break;
	case WORD_acos: r = acos(x > 1 ? 1 : x < -1 ? -1 : x); break;
	case WORD_atan: r = atan(x); break;
	case WORD_sinh: r = sinh(x); break;
	case WORD_cosh: r = cosh(x); break;
	case WORD_tanh: r = tanh(x); break;
	case WORD_asinh: r = asinh(x); break;
	case WORD_acosh: r = acosh(x); break;
	case WORD_atanh: r = atanh(x); break;
	case WORD_atan2: r = atan2(x, y); break;
	case WORD_degrees: r = x / degree; break;
	case WORD_radians: r = x * degree; break;
	case WORD_pow: r = pow(x, y); break;
	case WORD_mod: r = y != 0 ? fmod(x, y) : 0; break;
	case WORD_div: r = y != 0 ? trunc(x / y) : 0; break;
	case WORD_min: case WORD_max: r = fold(word, a, n); break;
	case WORD_sqr: r = x * x; break;
	case WORD_select: r = x < 0 ? a[1] : n == 3 || x == 0 ? a[2] : a[3]; break;
	case WORD_bitwise_and: case WORD_bitwise_or: case WORD_bitwise_xor: r = bitwise(word, x, y); break;
	default: return false;
	}
	*out = r;
	return true;
}

double pov_seed(struct pov *p, double seed)
{
	uint32_t *states = pov_grow(p, p->streams_random, p->random_count, &p->random_room, sizeof *states);
	if (!states)
		return 0;
	p->streams_random = states;
	states[p->random_count] = (uint32_t)(int64_t)(fabs(seed) < 9e18 ? seed : 0);
	return (double)p->random_count++;
}

double pov_random(struct pov *p, double stream)
{
	/* A stream that was never opened starts at 0, as in POV-Ray. */
	while (p->random_count <= 1 && !p->failed && !(stream < (double)p->random_count))
		pov_seed(p, 0);
	if (!(stream >= 0 && stream < (double)p->random_count)) {
		pov_refuse(p, "no stream of random numbers %g", stream);
		return 0;
	}
	uint32_t *state = &p->streams_random[(size_t)stream];
	*state = *state * 1812433253u + 12345u;
	return (double)*state / 4294967295.0;
}

/* Arguments of a function of floats, '(' to ')'. */
static struct pov_value call_math(struct pov *p, uint32_t word)
{
	double a[ARGUMENTS_MOST], r = 0;
	int n = 0, least = maths[word - WORD_abs].least, most = maths[word - WORD_abs].most;
	do {
		if (n == ARGUMENTS_MOST) {
			pov_refuse(p, "more than %d arguments", ARGUMENTS_MOST);
			break;
		}
		a[n++] = pov_float(p);
	} while (!pov_stopped(p) && pov_accept(p, ','));
	if (!pov_stopped(p) && (n < least || (most > 0 && n > most)))
		pov_refuse(p, "%s with %d arguments", p->names.text[word], n);
	if (!pov_stopped(p))
		pov_math(word, a, n, &r);
	return value_number(r);
}

static struct vec next_vector(struct pov *p)
{
	pov_accept(p, ',');
	return pov_vector(p);
}

static struct pov_value call_vector(struct pov *p, uint32_t word)
{
	struct vec a = pov_vector(p), b, axis;
	switch (word) {
	case WORD_vlength: return value_number(vec_length(a));
	case WORD_vnormalize: return value_vector(vec_unit(a));
	case WORD_vdot: return value_number(vec_dot(a, next_vector(p)));
	case WORD_vcross: return value_vector(vec_cross(a, next_vector(p)));
	case WORD_vrotate: {
		struct matrix m = pov_rotation(next_vector(p));
		return value_vector(matrix_direction(a, &m));
	}
	default:
		axis = vec_unit(next_vector(p));
		b = next_vector(p);
		struct matrix m = matrix_axis_rotation(axis, b.x * degree);
		return value_vector(matrix_direction(a, &m));
	}
}

/* vlength of a float or a vector of two and so on: of all components. */
static struct pov_value call_length(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	double square = 0;
	if (v.type != TYPE_NUMBER)
		pov_refuse(p, "the length of %s", value_type_name(v.type));
	if (v.count == 1)
		return value_number(sqrt(3) * fabs(v.a[0]));
	for (int i = 0; i < v.count; i++)
		square += v.a[i] * v.a[i];
	return value_number(sqrt(square));
}

/* Noise is not known here: its mean. */
static struct pov_value call_turbulence(struct pov *p)
{
	p->summary->unknown++;
	pov_note(p, "vturbulence is not known here");
	for (int i = 0; i < 4 && !pov_stopped(p); i++) {
		pov_expression(p);
		pov_accept(p, ',');
	}
	return value_vector(vec(0, 0, 0));
}

bool pov_is_call(uint32_t word)
{
	return word >= WORD_abs && word <= WORD_datetime && word != WORD_sum && word != WORD_prod;
}

struct pov_value pov_call(struct pov *p, uint32_t word)
{
	struct pov_value v = value_number(0);
	bool relations = p->relations, blanks = p->blanks;
	if (!pov_expect(p, '(') || !pov_enter(p))
		return v;
	p->relations = true;
	p->blanks = false;
	if (word <= WORD_bitwise_xor)
		v = call_math(p, word);
	else if (word == WORD_seed)
		v = value_number(pov_seed(p, pov_float(p)));
	else if (word == WORD_rand)
		v = value_number(pov_random(p, pov_float(p)));
	else if (word == WORD_vlength)
		v = call_length(p);
	else if (word <= WORD_vaxis_rotate)
		v = call_vector(p, word);
	else if (word == WORD_vturbulence)
		v = call_turbulence(p);
	else if (word <= WORD_trace)
		v = pov_call_object(p, word);
	else
		v = pov_call_string(p, word);
	pov_expect(p, ')');
	p->blank_vector = false;
	p->nested--;
	p->relations = relations;
	p->blanks = blanks;
	return v;
}
