/* SPDX-License-Identifier: MIT */
/* single.c - the library as one source file and one header.
 *
 *     single HEADER OUT.h FILE...     headers one after the other, each where another includes it first
 *     single SOURCE OUT.c FILE...     headers and sources one after the other, bottom layer first
 *     single BARE OUT.c FILE.c        a file without its comments, empty lines and columns
 *
 * Names that are local to a source and occur elsewhere, too (in a header, or local to another source), get
 * the source's name behind them. Literals (struct x){ ... } become SMEAR_LITERAL(x){ ... }, which is
 * x{ ... } in C++. */
#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILES_MAX = 1000, NAMES_MAX = 8000, NAME_BYTES = 80 };

struct file {
    const char *path;
    char stem[NAME_BYTES];
    char *text;
    bool is_source, is_written;
};

/* A name of file scope. */
struct name {
    char text[NAME_BYTES];
    int file;
};

static struct file files[FILES_MAX];
static struct name names[NAMES_MAX];
static int file_count, name_count;

static void fail(const char *path, const char *what)
{
    fprintf(stderr, "single: %s: %s\n", path, what);
    exit(1);
}

static char *read_all(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (f == NULL)
        fail(path, "cannot be read");
    size_t room = 1 << 22, size;
    char *text = malloc(room);
    if (text == NULL)
        fail(path, "out of memory");
    size = fread(text, 1, room - 1, f);
    if (size == room - 1)
        fail(path, "longer than four megabytes");
    fclose(f);
    text[size] = '\0';
    return text;
}

/* ------------------------------------------------------------------ tokens */

enum kind { END, SPACE, WORD, MARK, OTHER };    /* OTHER: comments, strings, numbers */

struct token {
    enum kind kind;
    const char *at;
    size_t length;
};

static struct token next_token(const char *p)
{
    struct token t = { OTHER, p, 1 };
    const char *q = p + 1;
    if (*p == '\0') {
        t.kind = END;
        t.length = 0;
        return t;
    }
    if (isspace((unsigned char)*p)) {
        t.kind = SPACE;
        while (isspace((unsigned char)*q))
            q++;
    } else if (p[0] == '/' && p[1] == '*') {
        q = strstr(p + 2, "*/");
        q = q != NULL ? q + 2 : p + strlen(p);
    } else if (*p == '"' || *p == '\'') {
        while (*q != '\0' && *q != *p)
            q += *q == '\\' ? 2 : 1;
        q++;
    } else if (isalpha((unsigned char)*p) || *p == '_') {
        t.kind = WORD;
        while (isalnum((unsigned char)*q) || *q == '_')
            q++;
    } else if (isdigit((unsigned char)*p)) {
        while (isalnum((unsigned char)*q) || *q == '.')
            q++;
    } else {
        t.kind = MARK;
        if (*p == '-' && *q == '>')
            q++;
    }
    t.length = (size_t)(q - p);
    return t;
}

/* The next token that is neither space nor comment. */
static bool is_comment(struct token t)
{
    return t.kind == OTHER && t.length > 1 && t.at[0] == '/';
}

static struct token next_solid(const char *p)
{
    struct token t;
    do {
        t = next_token(p);
        p += t.length;
    } while (t.kind == SPACE || is_comment(t));
    return t;
}

static bool is_word(struct token t, const char *word)
{
    return t.kind == WORD && t.length == strlen(word) && memcmp(t.at, word, t.length) == 0;
}

static bool is_mark(struct token t, char mark)
{
    return t.kind == MARK && t.at[0] == mark && t.length == 1;
}

/* ------------------------------------------------------------------ names of file scope */

static void add_name(struct token t, int file)
{
    if (t.length >= NAME_BYTES || name_count == NAMES_MAX)
        fail(files[file].path, "too many names");
    for (int i = 0; i < name_count; i++)
        if (names[i].file == file && strlen(names[i].text) == t.length
            && memcmp(names[i].text, t.at, t.length) == 0)
            return;
    memcpy(names[name_count].text, t.at, t.length);
    names[name_count].text[t.length] = '\0';
    names[name_count++].file = file;
}

/* Functions, objects, types, tags, constants of enums and macros
 * that the file declares outside of functions. */
static void find_names(int file)
{
    static const char *const keywords[] = {
        "static", "const", "extern", "inline", "void", "int", "unsigned", "char", "bool", "struct", "enum",
        "union", "typedef", "volatile", "__attribute__", "SMEAR_STATIC_ASSERT", "SMEAR_INLINE",
        "SMEAR_NOINLINE", "SMEAR_SHARED", NULL
    };
    int depth = 0, parentheses = 0;
    bool in_enum = false, in_value = false, line_start = true;      /* in_value: behind the = of an object */
    struct token before = { END, "", 0 }, before_that = before;
    for (const char *p = files[file].text; *p != '\0';) {
        struct token t = next_token(p);
        p += t.length;
        if (line_start && is_mark(t, '#')) {        /* a directive, with its continuations */
            struct token word = next_token(p);
            struct token name = next_solid(p + word.length);
            if (is_word(word, "define"))
                add_name(name, file);
            while (*p != '\0' && (*p != '\n' || p[-1] == '\\'))
                p++;
            continue;
        }
        if (t.kind == SPACE) {
            line_start = line_start || memchr(t.at, '\n', t.length) != NULL;
            continue;
        }
        line_start = false;
        if (t.kind == OTHER)
            continue;
        if (depth == 0 && (is_mark(t, '=') || is_mark(t, ';')))
            in_value = is_mark(t, '=');
        if (is_mark(t, '{')) {
            in_enum = in_enum || (depth == 0 && (is_word(before, "enum") || is_word(before_that, "enum")));
            depth++;
        } else if (is_mark(t, '}')) {
            depth--;
            in_enum = in_enum && depth > 0;
        } else if (is_mark(t, '(')) {
            parentheses++;
        } else if (is_mark(t, ')')) {
            parentheses--;
        } else if (t.kind == WORD && parentheses == 0 && (depth == 0 || (depth == 1 && in_enum))) {
            struct token after = next_solid(p);
            bool is_keyword = false;
            for (int i = 0; keywords[i] != NULL; i++)
                is_keyword = is_keyword || is_word(t, keywords[i]);
            bool is_tag = is_word(before, "struct") || is_word(before, "enum") || is_word(before, "union");
            if (depth == 1) {
                if (is_mark(before, '{') || is_mark(before, ','))
                    add_name(t, file);
            } else if (!is_keyword && !in_value && (is_tag ? is_mark(after, '{')
                                              : after.kind == MARK && strchr("(;=[,", after.at[0]) != NULL)) {
                add_name(t, file);
            }
        }
        before_that = before;
        before = t;
    }
}

/* A name of this source that means something else in another file. */
static bool collides(struct token t, int file)
{
    bool is_ours = false, is_elsewhere = false;
    for (int i = 0; i < name_count; i++) {
        if (strlen(names[i].text) != t.length || memcmp(names[i].text, t.at, t.length) != 0)
            continue;
        if (names[i].file == file)
            is_ours = true;
        else
            is_elsewhere = true;
    }
    /* Names of the interface between files are declared in a header and defined in a source. */
    return files[file].is_source && is_ours && is_elsewhere
        && (t.length < 6 || memcmp(t.at, "smear_", 6) != 0);
}

/* ------------------------------------------------------------------ writing */

/* Functions whose result is assigned to pointers of any type. */
static bool is_untyped(struct token t)
{
    return is_word(t, "arena_take") || is_word(t, "blob_at") || is_word(t, "blob_table");
}

/* Past a #include of our own, or null. */
static const char *skip_include(const char *p)
{
    if (strncmp(p, "#include \"", 10) != 0)
        return NULL;
    p += strcspn(p, "\n");
    return *p == '\n' ? p + 1 : p;
}

/* Returns the file that a line includes, or -1. */
static int included(const char *line)
{
    const char *name = strchr(line, '"') + 1;
    const size_t length = strcspn(name, "\"");
    for (int i = 0; i < file_count; i++) {
        const char *slash = strrchr(files[i].path, '/'), *own = slash != NULL ? slash + 1 : files[i].path;
        if (strlen(own) == length && memcmp(own, name, length) == 0)
            return i;
    }
    return -1;
}

static void write_file(FILE *out, int file, bool renames)
{
    const char *skipped;
    int struct_depth = 0, depth = 0;                /* of the braces of a struct's definition */
    struct token before = { END, "", 0 }, before_that = before;
    bool line_start = true;
    files[file].is_written = true;
    fprintf(out, "\n/* ==================================================================== %s */\n\n",
            files[file].path);
    for (const char *p = files[file].text; *p != '\0';) {
        struct token t = next_token(p);
        if (line_start && (skipped = skip_include(p)) != NULL) {
            const int other = renames ? -1 : included(p);
            if (other >= 0 && !files[other].is_written)
                write_file(out, other, renames);
            p = skipped;
            continue;
        }
        if (line_start && strncmp(p, "#include SMEAR_CONFIG_FILE", 26) != 0
            && strncmp(p, "/* SPDX", 7) == 0) {
            p += strcspn(p, "\n") + 1;
            continue;
        }
        if (is_mark(t, '(') && renames) {           /* (struct x){: a literal */
            struct token a = next_token(t.at + 1), space = next_token(a.at + a.length);
            struct token b = next_token(space.at + space.length), c = next_token(b.at + b.length);
            struct token d = next_token(c.at + c.length);
            bool is_plain = a.kind == WORD && is_mark(space, ')') && is_mark(b, '{');
            if (is_word(a, "struct") && b.kind == WORD && is_mark(c, ')') && is_mark(d, '{')) {
                fputs("SMEAR_LITERAL(", out);
                fprintf(out, "%.*s", (int)b.length, b.at);
                if (collides(b, file))
                    fprintf(out, "_in_%s", files[file].stem);
                fputs(")", out);
                p = c.at + 1;
                before_that = before;
                before = c;
                line_start = false;
                continue;
            }
            if (is_plain && !is_word(a, "struct")) {
                fprintf(out, "SMEAR_LITERAL_OF(%.*s)", (int)a.length, a.at);
                p = space.at + 1;
                before_that = before;
                before = space;
                line_start = false;
                continue;
            }
        }
        bool is_renamed = false;
        if (is_word(t, "const") || is_word(t, "void")) {    /* [const] void *arena_take( */
            bool is_const = is_word(t, "const");
            struct token first = is_const ? next_solid(p + t.length) : t;
            struct token star = next_solid(first.at + first.length);
            struct token function = next_solid(star.at + star.length);
            if (is_word(first, "void") && is_mark(star, '*') && is_untyped(function)) {
                fputs(is_const ? "SMEAR_UNTYPED_CONST " : "SMEAR_UNTYPED ", out);
                p = star.at + star.length;
                continue;
            }
        }
        if (t.kind == WORD && renames && collides(t, file)) {
            struct token after = next_solid(p + t.length);
            bool is_member = is_mark(before, '.') || (before.kind == MARK && before.length == 2)
                          || (struct_depth > 0 && !is_word(before, "struct") && after.kind == MARK
                              && strchr(";,[:)", after.at[0]) != NULL);
            /* [name] "constraint": strings of the assembly name this operand. */
            const bool is_operand = is_mark(before, '[') && is_mark(after, ']') && *next_solid(after.at + 1).at == '"';
            is_renamed = !is_member && !is_operand;
        }
        fwrite(t.at, 1, t.length, out);
        if (is_renamed)
            fprintf(out, "_in_%s", files[file].stem);
        if (is_mark(t, '{')) {
            depth++;
            if (struct_depth == 0 && (is_word(before, "struct") || is_word(before_that, "struct")
                                      || is_word(before, "union")) && !is_mark(before, ')'))
                struct_depth = depth;
        } else if (is_mark(t, '}')) {
            if (struct_depth == depth)
                struct_depth = 0;
            depth--;
        }
        line_start = t.kind == SPACE && memchr(t.at, '\n', t.length) != NULL && t.at[t.length - 1] == '\n';
        if (t.kind != SPACE && !is_comment(t)) {
            before_that = before;
            before = t;
        }
        p += t.length;
    }
}

/* The first two comments stay: the licence, and what the file is. Columns inside of lines go, indentation is of tabs. */
static void write_bare(FILE *out, const char *p)
{
    int kept = 2;
    size_t line = 0, blanks = 0;                    /* ends of lines and blanks behind them, not yet written */
    for (struct token t = next_token(p); t.kind != END; p += t.length, t = next_token(p)) {
        if (t.kind == SPACE) {
            const char *end = NULL;
            for (size_t i = 0; i < t.length; i++)
                end = t.at[i] == '\n' ? t.at + i : end;
            line |= end != NULL;
            blanks = end != NULL ? (size_t)(t.at + t.length - end) - 1 : line ? blanks + t.length : 1;
        } else if (is_comment(t) && kept-- <= 0) {
            blanks += blanks == 0;
        } else {
            if (line)
                fputc('\n', out);
            for (; line && blanks >= 4; blanks -= 4)
                fputc('\t', out);
            fprintf(out, "%*s%.*s", (int)blanks, "", (int)t.length, t.at);
            line = blanks = 0;
        }
    }
    fputc('\n', out);
}

static void write_head(FILE *out, bool is_source)
{
    fputs(is_source ? "/* SPDX-License-Identifier: MIT */\n"
                      "/* smear.c - the whole library, put together by `make dist` from the files "
                      "named below. C99 or later, or C++11.\n"
                      " * Needs smear.h beside it, and memcpy and memset. */\n"
                      "#include \"smear.h\"\n\n"
                      "#define SMEAR_COPY_IS_HERE 1    /* of what small code has once: there is no other file */\n"
                      "#ifdef __clang__       /* not every build needs every helper */\n"
                      "#pragma clang diagnostic ignored \"-Wunused-function\"\n"
                      "#endif\n"
                      "/* What differs in C++: literals, and pointers to untyped memory, "
                      "which become what they are assigned to. */\n"
                      "#ifdef __cplusplus\n"
                      "#ifdef __GNUC__\n"
                      "#pragma GCC diagnostic ignored \"-Wmissing-field-initializers\"\n"
                      "#ifndef __clang__     /* constants of enums beside integers, which C has always allowed */\n"
                      "#pragma GCC diagnostic ignored \"-Wextra\"\n"
                      "#endif\n"
                      "#if defined(__clang__) && __cplusplus < 202002L\n"
                      "#pragma clang diagnostic ignored \"-Wc++20-designator\"\n"
                      "#elif __cplusplus < 202002L && __GNUC__ >= 12\n"
                      "#pragma GCC diagnostic ignored \"-Wc++20-extensions\"\n"
                      "#elif __cplusplus < 202002L\n"
                      "#pragma GCC diagnostic ignored \"-Wpedantic\"\n"
                      "#endif\n"
                      "#define restrict __restrict__\n"
                      "#else\n"
                      "#define restrict\n"
                      "#endif\n"
                      "template <class type> using smear_literal = type;\n"
                      "#define SMEAR_LITERAL(name) smear_literal<struct name>\n"
                      "#define SMEAR_LITERAL_OF(type) smear_literal<type>\n"
                      "struct smear_untyped {\n"
                      "    const void *p;\n"
                      "    smear_untyped(const void *pointer) : p(pointer) {}\n"
                      "    template <class type> operator type *() const { return (type *)p; }\n"
                      "};\n"
                      "#define SMEAR_UNTYPED smear_untyped\n"
                      "#define SMEAR_UNTYPED_CONST smear_untyped\n"
                      "#else\n"
                      "#define SMEAR_LITERAL(name) (struct name)\n"
                      "#define SMEAR_LITERAL_OF(type) (type)\n"
                      "#define SMEAR_UNTYPED void *\n"
                      "#define SMEAR_UNTYPED_CONST const void *\n"
                      "#endif\n"
                    : "/* SPDX-License-Identifier: MIT */\n"
                      "/* smear.h - the interface of smear.c, put together by `make dist`: "
                      "configuration, library, models. C99, C++11. */\n",
          out);
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc - 3 > FILES_MAX) {
        fprintf(stderr, "usage: single HEADER|SOURCE|BARE OUT FILE..., at most %d of them\n", FILES_MAX);
        return 2;
    }
    bool is_source = strcmp(argv[1], "SOURCE") == 0;
    for (int i = 3; i < argc; i++) {
        struct file *f = &files[file_count++];
        const char *slash = strrchr(argv[i], '/');
        f->path = argv[i];
        snprintf(f->stem, sizeof f->stem, "%s", slash != NULL ? slash + 1 : argv[i]);
        f->is_source = f->stem[strlen(f->stem) - 1] == 'c';
        f->stem[strcspn(f->stem, ".")] = '\0';
        f->text = read_all(argv[i]);
        find_names(file_count - 1);
    }
    FILE *out = fopen(argv[2], "wb");
    if (out == NULL)
        fail(argv[2], "cannot be written");
    const bool is_bare = strcmp(argv[1], "BARE") == 0;
    if (is_bare)
        write_bare(out, files[0].text);
    else
        write_head(out, is_source);
    for (int i = 0; i < file_count && !is_bare; i++)
        if (!files[i].is_written)
            write_file(out, i, files[i].is_source || is_source);
    if (fclose(out) != 0)
        fail(argv[2], "cannot be written");
    return 0;
}
