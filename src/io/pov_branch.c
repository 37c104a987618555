/* Directives that choose and repeat. Tokens know where their branch ends, so that passing over one takes no time. */
#include "io/pov_reader.h"

static void push(struct pov *p, struct pov_branch b)
{
	struct pov_branch *all = pov_grow(p, p->branches, p->branch_count, &p->branch_room, sizeof *all);
	if (!all)
		return;
	p->branches = all;
	all[p->branch_count++] = b;
}

static struct pov_branch *innermost(const struct pov *p)
{
	return p->branch_count > p->source->branches ? &p->branches[p->branch_count - 1] : NULL;
}

static const struct pov_token *token_at(const struct pov *p, uint32_t index)
{
	return &p->source->file->tokens[index];
}

/* Where the branch that t opens or goes on with ends, or NULL (and refused). */
static const struct pov_token *end_of(struct pov *p, const struct pov_token *t)
{
	if (t->jump)
		return token_at(p, t->jump);
	pov_refuse(p, "'#%s' without '#end'", p->names.text[t->name]);
	return NULL;
}

static void count_round(struct pov *p)
{
	if (++p->rounds > p->options->budget.rounds)
		pov_stop(p, STATUS_INPUT, "more rounds of loops than the budget of %zu", p->options->budget.rounds);
}

static bool is_defined(struct pov *p)
{
	uint32_t name;
	pov_expect(p, '(');
	const struct pov_token *t = pov_peek_operator(p);
	bool defined = t->kind == TOKEN_NAME && t->name < WORD_COUNT;
	if (defined) {
		p->source->at++;
	} else {
		const struct pov_value *v = pov_variable(p, &name);
		defined = v && v->type != TYPE_NONE;
	}
	pov_expect(p, ')');
	return defined;
}

/* Go on at t; behind it, if it is an #else or the #end. Elseif is asked. */
static void choose(struct pov *p, const struct pov_token *t)
{
	while (t && !p->failed) {
		p->source->at = t + 1;
		if (t->name == WORD_else) {
			push(p, (struct pov_branch){ .word = WORD_if });
			return;
		}
		if (t->name != WORD_elseif)
			return;
		if (value_true(pov_condition(p))) {
			push(p, (struct pov_branch){ .word = WORD_if });
			return;
		}
		t = end_of(p, t);
	}
}

static void start_if(struct pov *p, const struct pov_token *t)
{
	const struct pov_token *end = end_of(p, t);
	bool yes = t->name == WORD_if ? value_true(pov_condition(p)) : is_defined(p) == (t->name == WORD_ifdef);
	if (!end || p->failed)
		return;
	if (yes)
		push(p, (struct pov_branch){ .word = WORD_if });
	else
		choose(p, end);
}

/* One round of a while more, or on behind its #end. t: the #while. */
static void try_while(struct pov *p, const struct pov_token *t)
{
	const struct pov_token *end = end_of(p, t);
	bool yes = value_true(pov_condition(p));
	if (!end || p->failed)
		return;
	count_round(p);
	if (yes)
		push(p, (struct pov_branch){ .word = WORD_while, .start = t });
	else
		p->source->at = end + 1;
}

static uint32_t frame_of(const struct pov *p)
{
	return (uint32_t)(p->source - p->sources);
}

static bool goes_on(double x, const struct pov_branch *b)
{
	return b->step > 0 ? x <= b->last + 1e-10 : x >= b->last - 1e-10;
}

static void start_for(struct pov *p, const struct pov_token *t)
{
	const struct pov_token *end = end_of(p, t);
	struct pov_branch b = { .word = WORD_for, .start = t, .step = 1 };
	p->relations = true;
	pov_expect(p, '(');
	const struct pov_token *name = pov_peek_operator(p);
	if (name->kind != TOKEN_NAME || name->name < WORD_COUNT) {
		pov_unexpected(p, name, "a name");
		return;
	}
	p->source->at++;
	b.variable = name->name;
	pov_expect(p, ',');
	struct pov_value first = value_number(pov_float(p));
	pov_expect(p, ',');
	b.last = pov_float(p);
	if (pov_accept(p, ','))
		b.step = pov_float(p);
	pov_expect(p, ')');
	if (!p->failed && fabs(b.step) < 1e-10)
		pov_refuse(p, "a #for with step 0");
	pov_declare_local(p, b.variable, frame_of(p), &first);
	if (!end || p->failed)
		return;
	b.body = p->source->at;
	count_round(p);
	if (goes_on(first.a[0], &b))
		push(p, b);
	else
		p->source->at = end + 1;
}

/* At the #end of a for, whose next token is at. */
static void next_for(struct pov *p, const struct pov_branch *b)
{
	const struct pov_binding *variable = scope_find(&p->scope, b->variable);
	if (!variable || variable->refers->type != TYPE_NUMBER) {
		pov_refuse(p, "the variable of #for is no number any more");
		return;
	}
	struct pov_value x = value_number(variable->refers->a[0] + b->step);
	struct pov_branch again = *b;
	count_round(p);
	pov_declare_local(p, b->variable, frame_of(p), &x);
	if (!p->failed && goes_on(x.a[0], b)) {
		p->source->at = again.body;
		push(p, again);
	}
}

static void start_switch(struct pov *p, const struct pov_token *t)
{
	double x = pov_condition(p);
	for (const struct pov_token *branch = end_of(p, t); branch && !p->failed; branch = end_of(p, branch)) {
		p->source->at = branch + 1;
		if (branch->name == WORD_end)
			return;
		bool yes = branch->name == WORD_else;
		p->relations = true;
		if (branch->name == WORD_case) {
			yes = fabs(pov_condition(p) - x) < 1e-10;
		} else if (branch->name == WORD_range) {
			pov_expect(p, '(');
			double low = pov_float(p);
			pov_expect(p, ',');
			double high = pov_float(p);
			pov_expect(p, ')');
			yes = x >= low - 1e-10 && x <= high + 1e-10;
		}
		if (yes && !p->failed) {
			push(p, (struct pov_branch){ .word = WORD_switch, .start = t });
			return;
		}
	}
}

/* The #end behind t, through all branches between. */
static const struct pov_token *last_end(struct pov *p, const struct pov_token *t)
{
	while (t && t->name != WORD_end)
		t = end_of(p, t);
	return t;
}

static void leave(struct pov *p)
{
	for (struct pov_branch *b; (b = innermost(p)) != NULL;) {
		struct pov_branch left = *b;
		p->branch_count--;
		if (left.word == WORD_if)
			continue;
		const struct pov_token *end = last_end(p, left.start);
		if (end)
			p->source->at = end + 1;
		return;
	}
	pov_refuse(p, "'#break' outside of loops and switches");
}

/* #else, #elseif, #case and #range behind a branch that was read: on behind the #end. A switch falls through. */
static void finish_branch(struct pov *p, const struct pov_token *t)
{
	const struct pov_branch *b = innermost(p);
	if (!b) {
		if (p->options->strict)
			pov_refuse(p, "'#%s' without '#if'", p->names.text[t->name]);
		return;
	}
	if (b->word == WORD_switch) {
		p->relations = true;
		if (t->name == WORD_case) {
			pov_condition(p);
		} else if (t->name == WORD_range) {
			pov_expect(p, '(');
			pov_float(p);
			pov_expect(p, ',');
			pov_float(p);
			pov_expect(p, ')');
		}
		return;
	}
	const struct pov_token *end = last_end(p, t);
	p->branch_count--;
	if (end)
		p->source->at = end + 1;
}

static void finish(struct pov *p)
{
	const struct pov_branch *b = innermost(p);
	if (!b) {
		if (p->options->strict)
			pov_refuse(p, "'#end' without a directive that it ends");
		return;
	}
	struct pov_branch done = *b;
	p->branch_count--;
	if (done.word == WORD_while) {
		p->source->at = done.start + 1;
		try_while(p, done.start);
	} else if (done.word == WORD_for) {
		next_for(p, &done);
	}
}

void pov_branch(struct pov *p, const struct pov_token *t)
{
	switch (t->name) {
	case WORD_if: case WORD_ifdef: case WORD_ifndef: start_if(p, t); break;
	case WORD_while: try_while(p, t); break;
	case WORD_for: start_for(p, t); break;
	case WORD_switch: start_switch(p, t); break;
	case WORD_break: leave(p); break;
	case WORD_end: finish(p); break;
	case WORD_else: case WORD_elseif: case WORD_case: case WORD_range: finish_branch(p, t); break;
	default: pov_unexpected(p, t, "a statement");
	}
}
