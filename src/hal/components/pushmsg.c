/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pushmsg.c - messages to the user when bits change, with values in the text.
 *
 * In:     msgs="l|pinname|text",... at load time; trigger, force and edge of each
 * Out:    messages of level error, warning, info or debug
 * Thread: pushmsg [servo], bounded by the number of messages
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_ctype.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Messages to the user");

#define MAX_MESSAGES 64
#define MAX_TEXT 127
#define MIN_TEXT 4
#define MAX_VALUES 2

static char *msgs[MAX_MESSAGES];
RTAPI_MP_ARRAY_STRING(msgs, MAX_MESSAGES, "level|pin name|text of each message");

/* A value in the text, and the text before it. */
struct value {
    char type;                          /* b s u l k f */
    hal_refs_u pin;
};

struct message {
    int level;
    int values;
    char text[MAX_VALUES + 1][MAX_TEXT + 1];    /* before each value, after the last */
    struct value value[MAX_VALUES];
    int was_triggered, was_forced;
    hal_bool_t trigger, force, edge;
};

static int comp_id, count;
static struct message *messages;
static struct {
    hal_bool_t pin;
} *enable;

/* ---- [servo] ------------------------------------------------------------- */

static int format_value(const struct value *v, char *buf, unsigned long size)
{
    switch(v->type) {
    case 'b': return rtapi_snprintf(buf, size, "%d", hal_get_bool(v->pin.b));
    case 's': return rtapi_snprintf(buf, size, "%d", hal_get_si32(v->pin.s));
    case 'u': return rtapi_snprintf(buf, size, "%u", hal_get_ui32(v->pin.u));
    case 'l': return rtapi_snprintf(buf, size, "%lld", (long long)hal_get_sint(v->pin.s));
    case 'k': return rtapi_snprintf(buf, size, "%llu", (unsigned long long)hal_get_uint(v->pin.u));
    default: return rtapi_snprintf(buf, size, "%lf", hal_get_real(v->pin.r));
    }
}

static void show(const struct message *m)
{
    char text[MAX_TEXT + 1];
    unsigned long used = 0;
    int i;
    for(i = 0; i <= m->values && used < sizeof text - 1; i++) {
        used += (unsigned long)rtapi_snprintf(text + used, sizeof text - used, "%s", m->text[i]);
        if(i == m->values || used >= sizeof text - 1) break;
        used += (unsigned long)format_value(&m->value[i], text + used, sizeof text - used);
    }
    rtapi_print_msg((msg_level_t)m->level, "%s\n", text);
}

/* HAL function pushmsg. */
static void pushmsg(void *arg, long period)
{
    int i, enabled = hal_get_bool(enable->pin);
    (void)arg;
    (void)period;
    for(i = 0; i < count; i++) {
        struct message *m = &messages[i];
        int triggered = hal_get_bool(m->trigger) != hal_get_bool(m->edge), forced = hal_get_bool(m->force);
        if((enabled && triggered && !m->was_triggered) || (forced && !m->was_forced)) show(m);
        m->was_triggered = triggered;
        m->was_forced = forced;
    }
}

/* ---- [init] -------------------------------------------------------------- */

static int refuse(int n, int error, const char *why)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "pushmsg: Message %d %s\n", n, why);
    return error;
}

static int refuse_char(int n, const char *what, char c, const char *expected)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "pushmsg: Message %d %s '%c', expected one of {%s}\n", n, what, c, expected);
    return -EBADMSG;
}

static int is_pin_name(const char *name, size_t length)
{
    size_t i;
    for(i = 0; i < length; i++)
        if(!(isascii((unsigned char)name[i]) && isalnum((unsigned char)name[i])) && !strchr("._-", name[i]))
            return 0;
    return length > 0;
}

static int export_value(struct value *v, const char *pin, const char *ref, int length)
{
#define MAKE(kind, member) \
    hal_pin_new_##kind(comp_id, HAL_IN, &v->pin.member, 0, "pushmsg.%s.%.*s", pin, length, ref)
    switch(v->type) {
    case 'b': return MAKE(bool, b);
    case 's': return MAKE(si32, s);
    case 'u': return MAKE(ui32, u);
    case 'l': return MAKE(sint, s);
    case 'k': return MAKE(uint, u);
    default: return MAKE(real, r);
    }
#undef MAKE
}

/* A substitution {t:ref} at text; *length is what it takes. */
static int parse_value(struct message *m, int n, const char *pin, const char *text, size_t *length)
{
    const char *end = strchr(text, '}'), *ref = text + 3;
    struct value *v = &m->value[m->values];
    size_t size;
    if(!end) return refuse(n, -EBADMSG, "missing '}' in substitution");
    if(end - text < 4) return refuse(n, -EBADMSG, "substitution too small, need type and pinname");
    if(text[2] != ':') return refuse(n, -EBADMSG, "substitution missing ':' after type character");
    size = (size_t)(end - ref);
    if(size + strlen(pin) + sizeof "pushmsg.." > HAL_NAME_LEN)
        return refuse(n, -EMSGSIZE, "substitution pin name too long");
    if(!is_pin_name(ref, size)) return refuse(n, -EBADMSG, "substitution pin name contains bad characters");
    v->type = (char)tolower((unsigned char)text[1]);
    if(!strchr("bfsukl", v->type))
        return refuse_char(n, "bad substitution type", text[1], "b,f,s,u,k,l");
    COMP_TRY(export_value(v, pin, ref, (int)size));
    m->values++;
    *length = (size_t)(end - text) + 1;
    return 0;
}

/* Splits the text at its substitutions. An escaped brace keeps its backslash. */
static int parse_text(struct message *m, int n, const char *pin, const char *text)
{
    size_t used = 0, length;
    while(*text) {
        if(text[0] == '\\' && text[1]) {
            m->text[m->values][used++] = *text++;
            m->text[m->values][used++] = *text++;
        } else if(*text == '{' && m->values < MAX_VALUES) {
            COMP_TRY(parse_value(m, n, pin, text, &length));
            text += length;
            used = 0;
        } else {
            m->text[m->values][used++] = *text++;
        }
    }
    return 0;
}

static int export_bits(struct message *m, int n, const char *pin)
{
    if(hal_pin_new_bool(comp_id, HAL_IN, &m->trigger, 0, "pushmsg.%s.trigger", pin))
        return refuse(n, -EINVAL, "cannot create trigger pin (duplicate?)");
    if(hal_pin_new_bool(comp_id, HAL_IN, &m->force, 0, "pushmsg.%s.force", pin))
        return refuse(n, -EINVAL, "cannot create force pin (duplicate?)");
    if(hal_pin_new_bool(comp_id, HAL_IN, &m->edge, 0, "pushmsg.%s.edge", pin))
        return refuse(n, -EINVAL, "cannot create edge pin (duplicate?)");
    return 0;
}

static int export_message(struct message *m, int n)
{
    static const char letters[] = "ewid";
    static const int levels[] = { RTAPI_MSG_ERR, RTAPI_MSG_WARN, RTAPI_MSG_INFO, RTAPI_MSG_DBG };
    const char *text = msgs[n], *name, *bar, *level;
    char pin[HAL_NAME_LEN + 1];
    size_t length = strlen(text);
    if(length > MAX_TEXT) return refuse(n, -EMSGSIZE, "too long, more than 127 characters");
    if(length < MIN_TEXT) return refuse(n, -EMSGSIZE, "too short, less than 4 characters");
    level = strchr(letters, tolower((unsigned char)text[0]));
    if(!level || !*level) return refuse_char(n, "has invalid type", text[0], "e,w,i,d");
    m->level = levels[level - letters];
    if(text[1] != '|') return refuse(n, -EBADMSG, "missing first '|' separator");
    name = text + 2;
    bar = strchr(name, '|');
    if(!bar) return refuse(n, -EBADMSG, "missing pin name, no second '|' separator");
    length = (size_t)(bar - name);
    if(length + sizeof "pushmsg..trigger" > HAL_NAME_LEN) return refuse(n, -EMSGSIZE, "pin name too long");
    if(!is_pin_name(name, length)) return refuse(n, -EBADMSG, "pin name contains bad characters");
    memcpy(pin, name, length);
    pin[length] = 0;
    COMP_TRY(export_bits(m, n, pin));
    return parse_text(m, n, pin, bar + 1);
}

static int export_all(void)
{
    int i;
    messages = hal_malloc((long)sizeof *messages * count);
    enable = hal_malloc(sizeof *enable);
    if(!messages || !enable) return -ENOMEM;
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &enable->pin, 1, "pushmsg.enable"));
    for(i = 0; i < count; i++) COMP_TRY(export_message(&messages[i], i));
    return hal_export_funct("pushmsg", pushmsg, NULL, 1, 0, comp_id);
}

int rtapi_app_main(void)
{
    int r;
    while(count < MAX_MESSAGES && msgs[count]) count++;
    if(count == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "pushmsg: No messages to handle\n");
        return -EINVAL;
    }
    comp_id = hal_init("pushmsg");
    if(comp_id < 0) return comp_id;
    r = export_all();
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
