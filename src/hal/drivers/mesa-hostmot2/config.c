/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * config.c - the config string of a board: words of the form token=value. [init]
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include "hm2.h"

#define MAX_WORD 255

static const char *const count_token[HM2_COUNTS] = {
    [HM2_NUM_ENCODERS] = "num_encoders",   [HM2_NUM_PWMGENS] = "num_pwmgens",   [HM2_NUM_TPPWMGENS] = "num_3pwmgens",
    [HM2_NUM_RCPWMGENS] = "num_rcpwmgens", [HM2_NUM_STEPGENS] = "num_stepgens", [HM2_NUM_RESOLVERS] = "num_resolvers",
    [HM2_NUM_BSPIS] = "num_bspis",         [HM2_NUM_UARTS] = "num_uarts",       [HM2_NUM_PKTUARTS] = "num_pktuarts",
    [HM2_NUM_INMUXS] = "num_inmuxs",       [HM2_NUM_INMS] = "num_inms",         [HM2_NUM_XY2MODS] = "num_xy2mods",
    [HM2_NUM_SSRS] = "num_ssrs",           [HM2_NUM_OUTMS] = "num_outms",       [HM2_NUM_ONESHOTS] = "num_oneshots",
    [HM2_NUM_PERIODMS] = "num_periodms",   [HM2_NUM_LEDS] = "num_leds",         [HM2_NUM_DPLLS] = "num_dplls",
};

const char *hm2_count_token(enum hm2_count what)
{
    return count_token[what];
}

/* The rest of word behind `key=`, or NULL. */
static const char *value_of(const char *word, const char *key)
{
    size_t n = strlen(key);
    return !strncmp(word, key, n) && word[n] == '=' ? word + n + 1 : NULL;
}

/* A whole number in C's notation. */
static int parse_number(struct hm2 *hm2, const char *word, const char *text, int *value)
{
    char *end;
    long n = strtol(text, &end, 0);
    if(end == text || *end || n < -1 || n > 1000) {
        HM2_ERR(hm2, "invalid token in config string: \"%s\": a whole number from 0 on belongs behind the =\n", word);
        return -EINVAL;
    }
    *value = (int)n;
    return 0;
}

/* sserial_port_P=MODES, of this port alone. */
static int parse_sserial(struct hm2 *hm2, const char *word, unsigned port, const char *modes)
{
    struct hm2_config *c = &hm2->config;
    unsigned i, n = 0;
    if(port >= HM2_SSERIAL_PORTS) {
        HM2_ERR(hm2, "invalid token in config string: \"%s\": ports are 0 to %d\n", word, HM2_SSERIAL_PORTS - 1);
        return -EINVAL;
    }
    for(i = 0; modes[i] && n < sizeof c->sserial_mode[port]; i++) {
        char m = (char)tolower((unsigned char)modes[i]);
        if(!isdigit((unsigned char)m) && m != 'x') continue;
        c->sserial_mode[port][n++] = m;
    }
    return 0;
}

static int parse_format(struct hm2 *hm2, const char *word, char formats[][HM2_FORMAT_LEN + 1], const char *rest)
{
    char *end;
    unsigned long channel = strtoul(rest, &end, 10);
    if(end == rest || *end != '=' || channel >= HM2_ABSENC_CHANNELS) {
        HM2_ERR(hm2, "invalid token in config string: \"%s\": channels are 0 to %d\n", word, HM2_ABSENC_CHANNELS - 1);
        return -EINVAL;
    }
    if(formats[channel][0]) {
        HM2_ERR(hm2, "invalid token in config string: \"%s\": this channel has a format already\n", word);
        return -EINVAL;
    }
    if(!end[1] || strlen(end + 1) > HM2_FORMAT_LEN) {
        HM2_ERR(hm2, "invalid token in config string: \"%s\": a format has 1 to %d characters\n", word, HM2_FORMAT_LEN);
        return -EINVAL;
    }
    strcpy(formats[channel], end + 1);
    return 0;
}

static int parse_word(struct hm2 *hm2, const char *word)
{
    struct hm2_config *c = &hm2->config;
    const char *value;
    unsigned port;
    int i, used = 0;
    for(i = 0; i < HM2_COUNTS; i++)
        if((value = value_of(word, count_token[i]))) return parse_number(hm2, word, value, &c->num[i]);
    if((value = value_of(word, "stepgen_width"))) return parse_number(hm2, word, value, &c->stepgen_width);
    if((value = value_of(word, "firmware"))) {
        if(strlen(value) > HM2_FORMAT_LEN) return -ENAMETOOLONG;
        strcpy(c->firmware, value);
        return 0;
    }
    if(sscanf(word, "sserial_port_%u=%n", &port, &used) == 1 && used)
        return parse_sserial(hm2, word, port, word + used);
    if(!strncmp(word, "ssi_chan_", 9)) return parse_format(hm2, word, c->ssi_format, word + 9);
    if(!strncmp(word, "biss_chan_", 10)) return parse_format(hm2, word, c->biss_format, word + 10);
    if(!strncmp(word, "fanuc_chan_", 11)) return parse_format(hm2, word, c->fanuc_format, word + 11);
    if(!strcmp(word, "enable_raw")) {
        c->enable_raw = true;
        return 0;
    }
    HM2_ERR(hm2, "invalid token in config string: \"%s\"\n", word);
    return -EINVAL;
}

/* The next word, with quotes and backslashes as in a shell. Gives what follows it; NULL: too long
 * or a quote that does not end. */
static const char *next_word(const char *p, char word[MAX_WORD + 1])
{
    char quote = 0;
    int n = 0;
    for(; *p && (quote || !isspace((unsigned char)*p)); p++) {
        if(*p == quote) {
            quote = 0;
            continue;
        }
        if(!quote && (*p == '"' || *p == '\'')) {
            quote = *p;
            continue;
        }
        if(*p == '\\' && quote != '\'' && p[1]) p++;
        if(n == MAX_WORD) return NULL;
        word[n++] = *p;
    }
    word[n] = 0;
    return quote ? NULL : p;
}

int hm2_config_parse(struct hm2 *hm2, const char *text)
{
    struct hm2_config *c = &hm2->config;
    const char *p = text ? text : "";
    char word[MAX_WORD + 1];
    int i;
    for(i = 0; i < HM2_COUNTS; i++) c->num[i] = -1;
    c->stepgen_width = 2;
    memset(c->sserial_mode, '0', sizeof c->sserial_mode);
    for(;;) {
        while(isspace((unsigned char)*p)) p++;
        if(!*p) return 0;
        const char *rest = next_word(p, word);
        if(!rest) {
            HM2_ERR(hm2, "invalid token in config string: \"%s\": a quote is not closed, or the word is too long\n", p);
            return -EINVAL;
        }
        COMP_TRY(parse_word(hm2, word));
        p = rest;
    }
}
