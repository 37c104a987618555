#include "io/pov_value.h"

#include <string.h>

enum { ARRAYS_NESTED_MOST = 100 };

const char *value_type_name(enum pov_type type)
{
	static const char *const names[] = { "an undefined value", "a number", "a string", "an array", "a spline", "a function", "an object",
		                             "a transform", "a texture", "a camera", "a file", "a macro" };
	return names[type];
}

double number_operate(uint32_t op, double a, double b)
{
	switch (op) {
	case '+': return a + b;
	case '-': return a - b;
	case '*': return a * b;
	case '/': return a / b;
	case '<': return a < b;
	case '>': return a > b;
	case TOKEN_LE: return a <= b + 1e-10;
	case TOKEN_GE: return a + 1e-10 >= b;
	case '=': return fabs(a - b) < 1e-10;
	case TOKEN_NE: return fabs(a - b) >= 1e-10;
	case '&': return value_true(a) && value_true(b);
	default: return value_true(a) || value_true(b);
	}
}

static bool compare_strings(int op, const struct pov_string *a, const struct pov_string *b, struct pov_value *out)
{
	bool equal = a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
	*out = value_number(op == '=' ? equal : !equal);
	return op == '=' || op == TOKEN_NE;
}

bool value_operate(int op, const struct pov_value *a, const struct pov_value *b, struct pov_value *out)
{
	if (a->type == TYPE_STRING && b->type == TYPE_STRING)
		return compare_strings(op, a->string, b->string, out);
	if (a->type != TYPE_NUMBER || b->type != TYPE_NUMBER)
		return false;
	int count = a->count > b->count ? a->count : b->count;
	struct pov_value r = { .type = TYPE_NUMBER, .count = (uint8_t)count, .color = a->color || b->color };
	for (int i = 0; i < count; i++)
		r.a[i] = number_operate((uint32_t)op, value_component(a, i), value_component(b, i));
	*out = r;
	return true;
}

struct pov_array *array_new(struct arena *mem, int dimensions, const size_t *size, size_t count)
{
	struct pov_array *a = NEW(mem, struct pov_array, 1);
	struct pov_value *all = NEW(mem, struct pov_value, count);
	if (!a || !all)
		return NULL;
	*a = (struct pov_array){ .dimensions = dimensions, .count = count, .all = all };
	memcpy(a->size, size, (size_t)dimensions * sizeof *size);
	return a;
}

static bool copy_value(struct arena *mem, const struct pov_value *from, struct pov_value *to, int depth)
{
	struct pov_value copy = *from;
	if (from->type == TYPE_ARRAY) {
		const struct pov_array *a = from->array;
		copy.array = depth < ARRAYS_NESTED_MOST ? array_new(mem, a->dimensions, a->size, a->count) : NULL;
		if (!copy.array)
			return false;
		for (size_t i = 0; i < a->count; i++)
			if (!copy_value(mem, &a->all[i], &copy.array->all[i], depth + 1))
				return false;
	}
	*to = copy;
	return true;
}

bool value_copy(struct arena *mem, const struct pov_value *from, struct pov_value *to)
{
	return copy_value(mem, from, to, 0);
}
