/* SPDX-License-Identifier: MIT */
/* test_json.c - the JSON reader: what it reads, what it refuses, and where it says the trouble
 * is. */
#include "tests/host.h"

#include "tools/model/json.h"

static bool parse(const char *text, struct json *out, struct failure *f)
{
    *f = (struct failure){ 0 };
    return json_parse((const uint8_t *)text, strlen(text), out, f);
}

static void test_values_of_every_type_are_read(void)
{
    struct json j;
    struct failure f;
    REQUIRE(parse(" { \"a\" : [ 1 , -2.5e1, true,false ,null, \"x\" ], \"b\":{}, \"c\":[] }\r\n",
                  &j, &f));
    CHECK_EQ(j.count, 10);
    CHECK_EQ(j.value[0].type, JSON_OBJECT);
    CHECK_EQ(j.value[0].count, 3);
    int a = json_member(&j, 0, "a");
    CHECK_EQ(j.value[a].type, JSON_ARRAY);
    CHECK_EQ(j.value[a].count, 6);
    static const enum json_type types[] = { JSON_NUMBER, JSON_NUMBER, JSON_TRUE, JSON_FALSE,
                                            JSON_NULL, JSON_STRING };
    int k = 0;
    for (int i = json_first(&j, a); i >= 0; i = json_after(&j, i))
        CHECK_EQ(j.value[i].type, types[k++]);
    CHECK_EQ(k, 6);
    CHECK_CLOSE(j.value[a + 1].number, 1, 0);
    CHECK_CLOSE(j.value[a + 2].number, -25, 0);
    CHECK(same_text(j.value[a + 6].string, "x"));
    CHECK_EQ(json_first(&j, json_member(&j, 0, "b")), -1);
    CHECK_EQ(json_first(&j, json_member(&j, 0, "c")), -1);
    CHECK_EQ(json_member(&j, 0, "d"), -1);
    CHECK_EQ(json_member(&j, a, "d"), -1);
    json_free(&j);
}

static void test_a_document_may_be_a_scalar_and_may_begin_with_a_byte_order_mark(void)
{
    struct json j;
    struct failure f;
    if (CHECK(parse("\xef\xbb\xbf 7 ", &j, &f))) {
        CHECK_CLOSE(j.value[0].number, 7, 0);
        json_free(&j);
    }
}

static void test_strings_are_unescaped_to_utf8(void)
{
    static const struct { const char *json, *text; } cases[] = {
        { "\"\"", "" },
        { "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"", "\"\\/\b\f\n\r\t" },
        { "\"\\u0041\\u00e9\\u20ac\"", "A\xc3\xa9\xe2\x82\xac" },
        { "\"\\ud83d\\ude00!\"", "\xf0\x9f\x98\x80!" },
        { "\"gr\xc3\xbc\xc3\x9f\xf4\x8f\xbf\xbf\"", "gr\xc3\xbc\xc3\x9f\xf4\x8f\xbf\xbf" },
        { "\"\x7f\"", "\x7f" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct json j;
        struct failure f;
        if (!CHECK(parse(cases[i].json, &j, &f)))
            continue;
        CHECK(same_text(j.value[0].string, cases[i].text));
        json_free(&j);
    }
}

static void test_numbers_follow_the_grammar_exactly(void)
{
    static const struct { const char *json; double value; } good[] = {
        { "0", 0 }, { "-0", 0 }, { "10", 10 }, { "0.5", 0.5 }, { "1e3", 1000 }, { "1E+2", 100 },
        { "25e-2", 0.25 }, { "-1.25e1", -12.5 }, { "9007199254740993", 9007199254740992 },
        { "1e-999", 0 }, { "0.1", 0.1 }
    };
    static const char *const bad[] = {
        "01", "-", "+1", ".5", "1.", "1e", "1e+", "0x10", "1_0", "NaN", "Infinity", "-Infinity",
        "1e999", "--1", "1.e2", "1,5"
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct json j;
        struct failure f;
        if (!CHECK(parse(good[i].json, &j, &f)))
            continue;
        CHECK_CLOSE(j.value[0].number, good[i].value, 0);
        json_free(&j);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct json j;
        struct failure f;
        CHECK(!parse(bad[i], &j, &f));
        CHECK(f.text[0] != '\0');
    }
}

static void test_syntax_errors_tell_line_and_column(void)
{
    static const struct { const char *json, *text; } cases[] = {
        { "", "text ends too early (line 1, column 1)" },
        { "  ", "text ends too early (line 1, column 3)" },
        { "{", "text ends too early (line 1, column 2)" },
        { "[1", "text ends too early (line 1, column 3)" },
        { "{\"a\"", "expected ':' (line 1, column 5)" },
        { "{\"a\":", "text ends too early (line 1, column 6)" },
        { "{\n  \"a\": 1\n  \"b\": 2\n}", "expected ',' or '}' (line 3, column 3)" },
        { "[1\n2]", "expected ',' or ']' (line 2, column 1)" },
        { "[1,]", "expected a value (line 1, column 4)" },
        { "[,1]", "expected a value (line 1, column 2)" },
        { "{,}", "expected a name (line 1, column 2)" },
        { "{\"a\":1,}", "expected a name (line 1, column 8)" },
        { "{a:1}", "expected a name (line 1, column 2)" },
        { "[1}", "expected ',' or ']' (line 1, column 3)" },
        { "{}}", "text goes on after its end (line 1, column 3)" },
        { "1 2", "text goes on after its end (line 1, column 3)" },
        { "[tru]", "expected a value (line 1, column 2)" },
        { "['a']", "expected a value (line 1, column 2)" },
        { "[1 /* no */]", "expected ',' or ']' (line 1, column 4)" },
        { "\n \"abc", "string has no end (line 2, column 2)" },
        { "\"a\nb\"", "control character in a string (line 1, column 3)" },
        { "[\"a\\n\\n\", x]", "expected a value (line 1, column 11)" },
        { "\"\\x\"", "bad escape in a string (line 1, column 2)" },
        { "\"\\u12g4\"", "bad escape in a string (line 1, column 2)" },
        { "\"\\u12", "bad escape in a string (line 1, column 2)" },
        { "\"\\", "bad escape in a string (line 1, column 2)" },
        { "\"\\u0000\"", "NUL character in a string (line 1, column 2)" },
        { "\"\\ud800\"", "half a surrogate pair in a string (line 1, column 2)" },
        { "\"\\ud800\\u0041\"", "half a surrogate pair in a string (line 1, column 2)" },
        { "\"\\ud800\\ue000\"", "half a surrogate pair in a string (line 1, column 2)" },
        { "\"\\udc00\"", "half a surrogate pair in a string (line 1, column 2)" },
        { "{\"a\":1,\"b\":2,\"a\":3}",
          "an object that ends here has a name twice (line 1, column 19)" },
        { "{\"a\":1,\"\\u0061\":3}",
          "an object that ends here has a name twice (line 1, column 18)" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct json j;
        struct failure f;
        CHECK(!parse(cases[i].json, &j, &f));
        CHECK(same_text(f.text, cases[i].text));
        CHECK(j.value == NULL && j.text == NULL);
    }
}

static void test_text_that_is_not_utf8_is_refused(void)
{
    static const char *const bad[] = {
        "\"\x80\"", "\"\xc3\"", "\"\xc0\xaf\"", "\"\xe0\x80\x80\"", "\"\xed\xa0\x80\"",
        "\"\xf0\x80\x80\x80\"", "\"\xf4\x90\x80\x80\"", "\"\xff\"", "\"\xe2\x82", "\"\xe2(\xa1\""
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct json j;
        struct failure f;
        CHECK(!parse(bad[i], &j, &f));
        CHECK(same_text(f.text, "text is not UTF-8 (line 1, column 2)"));
    }
}

static void test_depth_is_limited_and_needs_no_stack(void)
{
    enum { MUCH = 1000000 };
    char *text = malloc(MUCH + 1);
    struct json j;
    struct failure f;
    REQUIRE(text != NULL);
    memset(text, '[', JSON_MAX_DEPTH);
    memset(text + JSON_MAX_DEPTH, ']', JSON_MAX_DEPTH);
    text[2 * JSON_MAX_DEPTH] = '\0';
    if (CHECK(parse(text, &j, &f))) {
        CHECK_EQ(j.count, JSON_MAX_DEPTH);
        json_free(&j);
    }
    memset(text, '[', MUCH);
    text[MUCH] = '\0';
    CHECK(!parse(text, &j, &f));
    CHECK(same_text(f.text, "nested too deeply (line 1, column 258)"));
    free(text);
}

static void test_every_shortened_document_is_refused(void)
{
    const char *text = "{\"a\":[1,{\"b\":\"x\\u00e9\\n\",\"c\":-1.5e3}],\"d\":true}";
    size_t length = strlen(text);
    for (size_t n = 0; n < length; n++) {
        struct json j;
        struct failure f = { 0 };
        /* A block of exactly n bytes, so that a sanitizer sees any step beyond. */
        uint8_t *copy = malloc(n + 1);
        REQUIRE(copy != NULL);
        memcpy(copy, text, n);
        uint8_t *exact = realloc(copy, n == 0 ? 1 : n);
        CHECK(!json_parse(exact, n, &j, &f));
        free(exact);
    }
}

static void test_errors_of_meaning_tell_the_path(void)
{
    struct json j;
    struct failure f = { 0 };
    double number = 5;
    int64_t whole = 5;
    int index = 5;
    const char *string = NULL;
    bool flag = false, present = true;
    double three[3];
    REQUIRE(parse("{\"m\":[{},{\"p\":[{\"n\":\"x\",\"i\":2.5,\"k\":7,\"s\":1,\"v\":[1,2],"
                  "\"w\":[1,2,\"z\"],\"t\":3}]}]}", &j, &f));
    int m = json_member(&j, 0, "m");
    int object = json_first(&j, json_member(&j, json_after(&j, json_first(&j, m)), "p"));

    CHECK(!json_get_number(&j, object, "n", &number, &f));
    CHECK(same_text(f.text, "expected a number, found a string (m[1].p[0].n)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_integer(&j, object, "i", 0, 10, &whole, &f));
    CHECK(same_text(f.text, "2.5 is not a whole number (m[1].p[0].i)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_integer(&j, object, "k", 0, 6, &whole, &f));
    CHECK(same_text(f.text, "7 is not in 0 to 6 (m[1].p[0].k)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_index(&j, object, "k", 7, "node", &index, &f));
    CHECK(same_text(f.text, "there is no node 7 (m[1].p[0].k)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_string(&j, object, "s", &string, &f));
    CHECK(same_text(f.text, "expected a string, found a number (m[1].p[0].s)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_bool(&j, object, "t", &flag, &f));
    CHECK(same_text(f.text, "expected true or false, found a number (m[1].p[0].t)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_numbers(&j, object, "v", 3, three, &present, &f));
    CHECK(same_text(f.text, "expected 3 numbers, found 2 (m[1].p[0].v)"));
    f = (struct failure){ 0 };
    CHECK(!json_get_numbers(&j, object, "w", 3, three, &present, &f));
    CHECK(same_text(f.text, "expected a number, found a string (m[1].p[0].w[2])"));
    f = (struct failure){ 0 };
    CHECK(!json_get_array(&j, object, "k", &index, &f));
    CHECK(same_text(f.text, "expected an array, found a number (m[1].p[0].k)"));
    f = (struct failure){ 0 };
    json_fail(&j, object, "gone", &f, "no %s", "luck");
    CHECK(same_text(f.text, "no luck (m[1].p[0].gone)"));
    f = (struct failure){ 0 };
    json_fail(&j, 0, "top", &f, "bad");
    CHECK(same_text(f.text, "bad (top)"));

    /* What is absent changes nothing. */
    f = (struct failure){ 0 };
    number = 5;
    CHECK(json_get_number(&j, object, "zz", &number, &f) && number >= 5 && number <= 5);
    CHECK(json_get_integer(&j, -1, "zz", 0, 1, &whole, &f) && whole == 5);
    CHECK(json_get_numbers(&j, object, "zz", 3, three, &present, &f) && !present);
    json_free(&j);
}

static void test_long_and_rude_names_cannot_break_the_message(void)
{
    char text[600] = "{\"";
    struct json j;
    struct failure f;
    memset(text + 2, 'n', 400);
    strcat(text, "\\u0007\":{\"x\":1}}");
    double number;
    REQUIRE(parse(text, &j, &f));
    int object = 1, array;
    CHECK(!json_get_array(&j, object, "x", &array, &f));
    CHECK(strlen(f.text) < sizeof f.text);
    CHECK(strstr(f.text, "nnn?.x)") != NULL);
    f = (struct failure){ 0 };
    CHECK(!json_get_number(&j, 0, j.value[object].key, &number, &f));
    json_free(&j);
}

#include "build/suites/json.h"
