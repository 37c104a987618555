/* Height fields from images. GIF, TGA, BMP and the Netpbm formats are read here, of several images the first. */
#include "io/pov_image.h"

#include "io/pov_picture.h"

#include <stdlib.h>
#include <string.h>

enum { CODES = 4096 };

static unsigned byte(struct picture *p)
{
	if (p->at < p->end)
		return *p->at++;
	p->spent = true;
	return 0;
}

static unsigned word(struct picture *p)
{
	unsigned low = byte(p);
	return low | byte(p) << 8;
}

static void skip(struct picture *p, size_t n)
{
	if ((size_t)(p->end - p->at) < n)
		p->spent = true;
	p->at = p->spent ? p->end : p->at + n;
}

/* Netpbm: P2 P3 in digits, P5 P6 in bytes. */

static unsigned netpbm_number(struct picture *p)
{
	unsigned n = 0, c = byte(p);
	while (!p->spent && (c < '0' || c > '9')) {
		while (c == '#' && !p->spent && byte(p) != '\n')
			;
		c = byte(p);
	}
	for (; !p->spent && c >= '0' && c <= '9' && n < 100000000; c = byte(p))
		n = 10 * n + (c - '0');
	p->spent = p->spent && p->at < p->end; /* a number may end the file */
	return n;
}

static bool read_netpbm(struct picture *p)
{
	unsigned kind = p->at[1];
	skip(p, 2);
	unsigned width = netpbm_number(p), height = netpbm_number(p), most = netpbm_number(p);
	bool color = kind == '3' || kind == '6', digits = kind < '4';
	if (most < 1 || most > 65535 || !picture_open(p, width, height))
		return false;
	for (int y = 0; y < p->height; y++)
		for (int x = 0; x < p->width; x++) {
			unsigned v[3] = { 0, 0, 0 };
			for (int k = 0; k < (color ? 3 : 1); k++) {
				if (digits && p->at == p->end)
					return false;
				v[k] = digits ? netpbm_number(p) : byte(p);
				if (!digits && most > 255)
					v[k] = v[k] << 8 | byte(p);
			}
			picture_put(p, x, y, color ? picture_height_of_color(v[0] * 255 / most, v[1] * 255 / most) : (double)v[0] / most);
		}
	return !p->spent;
}

/* GIF: indices, packed by LZW in blocks of bytes. */

struct bits {
	struct picture *p;
	unsigned block; /* bytes left of it */
	uint32_t held;
	int count;
};

static int next_code(struct bits *b, int size)
{
	while (b->count < size) {
		if (b->block == 0 && (b->block = byte(b->p)) == 0)
			return -1;
		b->block--;
		b->held |= (uint32_t)byte(b->p) << b->count;
		b->count += 8;
		if (b->p->spent)
			return -1;
	}
	int code = (int)(b->held & ((1u << size) - 1));
	b->held >>= size;
	b->count -= size;
	return code;
}

/* Write the string of a code backwards from 'end'; returns its length. */
static int spell(const uint16_t *prefix, const unsigned char *suffix, int code, int clear, unsigned char *end)
{
	int n = 0;
	for (; code > clear && n < CODES; code = prefix[code])
		*--end = suffix[code], n++;
	*--end = (unsigned char)code;
	return n + 1;
}

static bool unpack_gif(struct picture *p, unsigned char *pixels, size_t count)
{
	uint16_t prefix[CODES];
	unsigned char suffix[CODES], text[CODES + 2];
	int least = (int)byte(p);
	struct bits b = { .p = p };
	if (least < 1 || least > 8)
		return false;
	int clear = 1 << least, next = clear + 2, size = least + 1, before = -1, code;
	size_t n = 0;
	while (n < count && (code = next_code(&b, size)) >= 0 && code != clear + 1) {
		if (code == clear) {
			next = clear + 2;
			size = least + 1;
			before = -1;
			continue;
		}
		if (code > next || (code == next && before < 0) || (before < 0 && code >= clear))
			return false;
		unsigned char *end = text + CODES + 1;
		int known = code < next ? code : before, length = spell(prefix, suffix, known, clear, end);
		unsigned char first = end[-length];
		if (code == next) {
			*end = first;
			end++;
			length++;
		}
		if (before >= 0 && next < CODES) {
			prefix[next] = (uint16_t)before;
			suffix[next++] = first;
			size += next == 1 << size && size < 12;
		}
		before = code;
		for (int i = 0; i < length && n < count; i++)
			pixels[n++] = end[i - length];
	}
	return n == count;
}

static bool read_gif(struct picture *p)
{
	skip(p, 10);
	unsigned flags = byte(p), kind;
	skip(p, 2);
	if (flags & 0x80)
		skip(p, (size_t)3 << ((flags & 7) + 1));
	while ((kind = byte(p)) == '!') {
		byte(p);
		for (unsigned n; (n = byte(p)) != 0;)
			skip(p, n);
	}
	if (kind != ',')
		return false;
	skip(p, 4);
	unsigned width = word(p), height = word(p);
	flags = byte(p);
	if (flags & 0x80)
		skip(p, (size_t)3 << ((flags & 7) + 1));
	if (p->spent || !picture_open(p, width, height))
		return false;
	size_t count = (size_t)width * height;
	unsigned char *pixels = malloc(count);
	bool done = pixels && unpack_gif(p, pixels, count);
	static const int from[4] = { 0, 4, 2, 1 }, step[4] = { 8, 8, 4, 2 };
	int pass = 0, row = 0;
	for (int y = 0; done && y < p->height; y++) {
		for (int x = 0; x < p->width; x++)
			picture_put(p, x, flags & 0x40 ? row : y, pixels[(size_t)y * width + (size_t)x] / 255.0);
		for (row += step[pass]; pass < 3 && row >= p->height;)
			row = from[++pass];
	}
	free(pixels);
	return done;
}

/* POT, of Fractint: a GIF of twice the width, high bytes at the left, low bytes at the right. */
static bool read_pot(struct picture *p)
{
	if (!read_gif(p))
		return false;
	struct picture wide = *p;
	if (!picture_open(p, (uint64_t)wide.width / 2, (uint64_t)wide.height))
		return false;
	for (int y = 0; y < p->height; y++)
		for (int x = 0; x < p->width; x++) {
			const double *row = wide.heights + (size_t)y * (size_t)wide.width;
			p->heights[(size_t)y * (size_t)p->width + (size_t)x] = 255 * (256 * row[x] + row[x + p->width]) / 65535;
		}
	return true;
}

/* TGA: indices, colours or grey, plain or in runs. */

static double tga_pixel(struct picture *p, int kind, int bits)
{
	unsigned b[4] = { 0, 0, 0, 0 };
	for (int k = 0; k < (bits + 7) / 8 && k < 4; k++)
		b[k] = byte(p);
	if (bits == 8)
		return b[0] / 255.0;
	if (bits == 16 && kind == 3)
		return (b[0] | b[1] << 8) / 65535.0;
	if (bits <= 16)
		return picture_height_of_color((b[1] >> 2 & 31) * 255 / 31, ((b[1] & 3) << 3 | b[0] >> 5) * 255 / 31);
	return picture_height_of_color(b[2], b[1]);
}

static bool read_tga(struct picture *p)
{
	if (p->end - p->at < 18)
		return false;
	unsigned name = byte(p), map = byte(p), type = byte(p);
	skip(p, 2);
	unsigned entries = word(p), entry = byte(p);
	skip(p, 4);
	unsigned width = word(p), height = word(p), bits = byte(p), order = byte(p);
	int kind = type & 7;
	skip(p, name + (map ? (size_t)entries * ((entry + 7) / 8) : 0));
	if (kind < 1 || kind > 3 || type > 11 || bits < 8 || bits > 32 || p->spent || !picture_open(p, width, height))
		return false;
	unsigned left = 0;
	bool run = false;
	double value = 0;
	for (int y = 0; y < p->height; y++)
		for (int x = 0; x < p->width; x++) {
			bool fresh = true;
			if (type & 8) {
				if (left == 0) {
					unsigned head = byte(p);
					run = head & 128;
					left = (head & 127) + 1;
				} else {
					fresh = !run;
				}
				left--;
			}
			value = fresh ? tga_pixel(p, kind, (int)bits) : value;
			picture_put(p, x, order & 32 ? y : p->height - 1 - y, value);
			if (p->spent)
				return false;
		}
	return true;
}

/* BMP of 8 bits (indices), 24 or 32, not packed. */
static bool read_bmp(struct picture *p)
{
	const unsigned char *start = p->at;
	skip(p, 10);
	size_t first = word(p);
	first |= (size_t)word(p) << 16;
	skip(p, 4);
	int32_t side[2];
	for (int k = 0; k < 2; k++) {
		uint32_t low = word(p);
		side[k] = (int32_t)(low | (uint32_t)word(p) << 16);
	}
	skip(p, 2);
	unsigned bits = word(p), packed = word(p);
	bool down = side[1] < 0;
	if (p->spent || packed || (bits != 8 && bits != 24 && bits != 32) || side[0] < 0 || side[1] == INT32_MIN ||
	    first > (size_t)(p->end - start) || !picture_open(p, (uint64_t)side[0], (uint64_t)(down ? -side[1] : side[1])))
		return false;
	p->at = start + first;
	for (int y = 0; y < p->height; y++) {
		for (int x = 0; x < p->width; x++) {
			unsigned blue = byte(p), green = bits > 8 ? byte(p) : 0, red = bits > 8 ? byte(p) : 0;
			if (bits == 32)
				byte(p);
			picture_put(p, x, down ? y : p->height - 1 - y, bits == 8 ? blue / 255.0 : picture_height_of_color(red, green));
		}
		if (p->spent)
			return false;
		if (y + 1 < p->height)
			skip(p, (4 - (size_t)p->width * (bits / 8) % 4) % 4);
	}
	return true;
}

static bool starts(const struct picture *p, const char *mark, size_t n)
{
	return (size_t)(p->end - p->at) >= n && memcmp(p->at, mark, n) == 0;
}

static const struct format {
	const char *type, *mark;
	size_t size;
	bool (*read)(struct picture *p);
} formats[] = {
	{ NULL, "\x89PNG", 4, picture_read_png },
	{ NULL, "\xff\xd8\xff", 3, picture_read_jpeg },
	{ "pot", "GIF8", 4, read_pot },
	{ NULL, "GIF8", 4, read_gif },
	{ NULL, "BM", 2, read_bmp },
	{ NULL, "P2", 2, read_netpbm },
	{ NULL, "P3", 2, read_netpbm },
	{ NULL, "P5", 2, read_netpbm },
	{ NULL, "P6", 2, read_netpbm },
	{ "tga", "", 0, read_tga },
};

double *pov_image_heights(struct arena *a, const void *bytes, size_t n, const char *type, int *width, int *height, const char **why)
{
	struct picture p = { .mem = a, .at = bytes, .end = (const unsigned char *)bytes + n };
	*why = "an image of a kind that is not read";
	for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
		const struct format *f = &formats[i];
		if (!starts(&p, f->mark, f->size) || (f->type && !(type && strcmp(type, f->type) == 0)))
			continue;
		*why = "a damaged image, or one too large or too small";
		if (!f->read(&p))
			return NULL;
		*width = p.width;
		*height = p.height;
		return p.heights;
	}
	return NULL;
}
