/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * clp.c - reads ladder projects.
 *
 * A .clp file is its parts one after the other, each between _FILE-NAME and
 * _/FILE-NAME. Each part has a reader that takes one line at a time.
 */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "classicladder/clp.h"

#define LINE_LEN 1024

struct reader {
    struct ladder *l;
    const char *file;
    char *message;
    int line, failed;
    int item;                   /* lines read that hold an object */
    int rung;                   /* of the part rung_N.csv */
};

static int fail(struct reader *r, const char *what, const char *text)
{
    if(!r->failed) snprintf(r->message, CLP_MESSAGE, "%s:%d: %s: %.100s", r->file, r->line, what, text);
    r->failed = 1;
    return -1;
}

/* Integers separated by `separators`; how many there are, at most n. */
static int integers(const char *text, const char *separators, int *values, int n)
{
    int count = 0;
    while(count < n) {
        char *end;
        long value = strtol(text, &end, 10);
        if(end == text) break;
        values[count++] = (int)value;
        text = end;
        while(*text == ' ') text++;
        if(!*text || !strchr(separators, *text)) break;
        text++;
    }
    return count;
}

/* Copies text up to an end mark into a field of size bytes. */
static void copy(char *field, size_t size, const char *text, const char *ends)
{
    size_t length = strcspn(text, ends);
    if(length >= size) length = size - 1;
    memcpy(field, text, length);
    field[length] = 0;
}

/* The value of KEY=value if the line is one, else NULL. */
static const char *value_of(const char *text, const char *key)
{
    size_t length = strlen(key);
    return !strncmp(text, key, length) && text[length] == '=' ? text + length + 1 : NULL;
}

/* ---- Parts ----------------------------------------------------------------- */

static void read_general(struct reader *r, const char *text)
{
    const char *value = value_of(text, "PERIODIC_REFRESH");
    if(value) r->l->refresh_ms = atoi(value);
}

static void read_com_params(struct reader *r, const char *text)
{
    struct modbus_config *m = &r->l->modbus;
    const struct {
        const char *key;
        int32_t *value;
    } keys[] = {
        { "MODBUS_MASTER_SERIAL_SPEED", &m->speed }, { "MODBUS_MASTER_SERIAL_DATABITS", &m->data_bits },
        { "MODBUS_MASTER_SERIAL_STOPBITS", &m->stop_bits }, { "MODBUS_MASTER_SERIAL_PARITY", &m->parity },
        { "MODBUS_ELEMENT_OFFSET", &m->element_offset }, { "MODBUS_MASTER_SERIAL_USE_RTS_TO_SEND", &m->use_rts },
        { "MODBUS_MASTER_TIME_INTER_FRAME", &m->inter_frame_ms },
        { "MODBUS_MASTER_TIME_OUT_RECEIPT", &m->time_out_ms },
        { "MODBUS_MASTER_TIME_AFTER_TRANSMIT", &m->after_transmit_ms },
        { "MODBUS_DEBUG_LEVEL", &m->debug_level }, { "MODBUS_MAP_COIL_READ", &m->map_read_coils },
        { "MODBUS_MAP_COIL_WRITE", &m->map_write_coils }, { "MODBUS_MAP_INPUT", &m->map_read_inputs },
        { "MODBUS_MAP_HOLDING", &m->map_read_input_regs },
        { "MODBUS_MAP_REGISTER_READ", &m->map_read_hold_regs },
        { "MODBUS_MAP_REGISTER_WRITE", &m->map_write_hold_regs },
    };
    const char *port = value_of(text, "MODBUS_MASTER_SERIAL_PORT");
    size_t i;
    if(port) copy(m->serial_port, sizeof m->serial_port, port, "");
    for(i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        const char *value = value_of(text, keys[i].key);
        if(value) *keys[i].value = atoi(value);
    }
}

/* Milliseconds of a base code: 0 minutes, 1 seconds, 2 tenths. */
static int base_ms(int code)
{
    return code == 0 ? 60000 : code == 1 ? 1000 : 100;
}

static void read_timer(struct reader *r, struct timer *timers, int count, const char *text)
{
    int v[2];
    struct timer *t;
    if(integers(text, ",", v, 2) != 2) {
        fail(r, "expected base,preset", text);
    } else if(r->item < count) {
        int64_t preset = (int64_t)v[1] * base_ms(v[0]);
        t = &timers[r->item++];
        t->base_ms = base_ms(v[0]);
        t->preset = preset < 0 || preset > INT32_MAX ? INT32_MAX : (int32_t)preset;
    }
}

static void read_timers(struct reader *r, const char *text)
{
    read_timer(r, LADDER(r->l, timers, struct timer), r->l->sizes.timers, text);
}

static void read_monostables(struct reader *r, const char *text)
{
    read_timer(r, LADDER(r->l, monostables, struct timer), r->l->sizes.monostables, text);
}

static void read_counters(struct reader *r, const char *text)
{
    int preset;
    if(integers(text, ",", &preset, 1) != 1) fail(r, "expected preset", text);
    else if(r->item < r->l->sizes.counters) LADDER(r->l, counters, struct counter)[r->item++].preset = preset;
}

static void read_timers_iec(struct reader *r, const char *text)
{
    int v[3];
    if(integers(text, ",", v, 3) != 3) {
        fail(r, "expected base,preset,mode", text);
    } else if(r->item < r->l->sizes.timers_iec) {
        struct timer_iec *t = &LADDER(r->l, timers_iec, struct timer_iec)[r->item++];
        t->base_ms = base_ms(v[0]);
        t->preset = v[1];
        t->mode = v[2];
    }
}

static void read_expression(struct reader *r, const char *text)
{
    int number = r->item++;
    const char *comma = strchr(text, ',');
    if(isdigit((unsigned char)text[0]) && comma && comma - text == 4) {
        number = atoi(text);
        text = comma + 1;
    }
    if(number < 0 || number >= r->l->sizes.expressions) {
        if(*text) fail(r, "more arithmetic expressions than numArithmExpr", text);
        return;
    }
    copy(LADDER(r->l, expressions, struct expression)[number].text, EXPR_LEN, text, "");
}

static void read_section(struct reader *r, const char *text)
{
    struct section *sections = LADDER(r->l, sections, struct section);
    int v[6];
    if(!strncmp(text, "#NAME", 5)) {
        int number = atoi(text + 5);
        const char *name = strchr(text, '=');
        if(name && number >= 0 && number < r->l->sizes.sections)
            copy(sections[number].name, SECTION_NAME_LEN, name + 1, "");
        return;
    }
    if(text[0] == '#') return;
    if(integers(text, ",", v, 6) != 6) {
        fail(r, "expected number,language,subroutine,first rung,last rung,page", text);
    } else if(v[0] < 0 || v[0] >= r->l->sizes.sections) {
        fail(r, "more sections than numSections", text);
    } else {
        struct section *s = &sections[v[0]];
        if(r->item++ == 0) sections[0].used = 0;        /* the one that an empty program has */
        s->used = 1;
        s->language = v[1];
        s->subroutine = v[2];
        s->first_rung = v[3];
        s->last_rung = v[4];
        s->page = v[5];
    }
}

/* A cell, type-top-vartype/varnum[idxtype/idxnum]; false if it is none. */
static int read_cell(struct cell *c, const char *text)
{
    int type, top, var_type, var_number, index_type, index_number, used = 0;
    if(sscanf(text, "%d-%d-%d/%d%n", &type, &top, &var_type, &var_number, &used) < 4) return 0;
    memset(c, 0, sizeof *c);
    c->type = (int16_t)type;
    c->with_top = (int16_t)top;
    c->var = (struct var_ref){ var_type, var_number, -1, 0 };
    if(sscanf(text + used, "[%d/%d]", &index_type, &index_number) == 2) {
        c->var.index_type = index_type;
        c->var.index_number = index_number;
    }
    return 1;
}

static void read_rung(struct reader *r, const char *text)
{
    struct rung *rung;
    const char *value;
    int x, y = r->item;
    if(r->rung < 0 || r->rung >= r->l->sizes.rungs) {
        fail(r, "more rungs than numRungs", text);
        return;
    }
    rung = &LADDER(r->l, rungs, struct rung)[r->rung];
    rung->used = 1;
    if(text[0] == '#') {
        if((value = value_of(text, "#LABEL"))) copy(rung->label, LABEL_LEN, value, "");
        if((value = value_of(text, "#COMMENT"))) copy(rung->comment, COMMENT_LEN, value, "");
        if((value = value_of(text, "#PREVRUNG"))) rung->prev = atoi(value);
        if((value = value_of(text, "#NEXTRUNG"))) rung->next = atoi(value);
        return;
    }
    if(y >= RUNG_HEIGHT) return;
    for(x = 0; x < RUNG_WIDTH; x++) {
        if(!text || !read_cell(&rung->cell[y][x], text)) {
            fail(r, "expected ten cells type-top-vartype/varnum", text ? text : "end of line");
            return;
        }
        text = strchr(text, ',');
        if(text) text++;
    }
    r->item++;
}

static void read_step(struct reader *r, const char *text)
{
    int v[6];
    if(integers(text + 1, ",", v, 6) != 6 || v[0] < 0 || v[0] >= STEPS) {
        fail(r, "expected Snumber,init,step,page,x,y", text);
        return;
    }
    r->l->step[v[0]] = (struct step){ .used = 1, .initial = v[1], .number = v[2], .page = v[3], .x = v[4], .y = v[5] };
}

static void read_transition(struct reader *r, const char *text)
{
    int v[1 + 4 * SWITCHES + 3], k;
    struct transition *t;
    if(integers(text + 1, ",", v, 1 + 4 * SWITCHES + 3) != 1 + 4 * SWITCHES + 3 || v[0] < 0 || v[0] >= TRANSITIONS) {
        fail(r, "expected Tnumber, four times ten numbers, page,x,y", text);
        return;
    }
    t = &r->l->transition[v[0]];
    t->used = 1;
    for(k = 0; k < SWITCHES; k++) {
        t->activate[k] = v[1 + k];
        t->deactivate[k] = v[1 + SWITCHES + k];
        t->starts[k] = v[1 + 2 * SWITCHES + k];
        t->ends[k] = v[1 + 3 * SWITCHES + k];
    }
    t->page = v[1 + 4 * SWITCHES];
    t->x = v[2 + 4 * SWITCHES];
    t->y = v[3 + 4 * SWITCHES];
}

static void read_condition(struct reader *r, const char *text)
{
    int number, zero, type, variable;
    if(sscanf(text + 1, "%d,%d,%d/%d", &number, &zero, &type, &variable) != 4 || number < 0 || number >= TRANSITIONS) {
        fail(r, "expected Cnumber,0,vartype/varnum", text);
        return;
    }
    r->l->transition[number].condition = (struct var_ref){ type, variable, -1, 0 };
}

static void read_sequential(struct reader *r, const char *text)
{
    int v[4];
    const char *rest;
    int i;
    switch(text[0]) {
    case 'S': read_step(r, text); break;
    case 'T': read_transition(r, text); break;
    case 'C': read_condition(r, text); break;
    case 'N':
        if(integers(text + 1, ",", v, 4) != 4 || v[0] < 0 || v[0] >= SEQ_COMMENTS) {
            fail(r, "expected Nnumber,page,x,y,text", text);
            break;
        }
        for(rest = text, i = 0; i < 4 && rest; i++) rest = (rest = strchr(rest, ',')) ? rest + 1 : NULL;
        r->l->seq_comment[v[0]] = (struct seq_comment){ .used = 1, .page = v[1], .x = v[2], .y = v[3] };
        if(rest) copy(r->l->seq_comment[v[0]].text, COMMENT_LEN, rest, "");
        break;
    default: break;
    }
}

static void read_modbus_request(struct reader *r, const char *text)
{
    struct modbus_request *q;
    const char *comma = strchr(text, ',');
    int v[5];
    if(text[0] == '#') return;
    if(!comma || integers(comma + 1, ",", v, 5) != 5) {
        fail(r, "expected slave,request,first,count,inverted,offset", text);
    } else if(r->item >= MODBUS_REQUESTS) {
        fail(r, "more than 20 Modbus requests", text);
    } else {
        q = &r->l->modbus.request[r->item++];
        copy(q->slave, sizeof q->slave, text, ",");
        q->used = q->slave[0] != 0;
        q->kind = v[0];
        q->first = v[1];
        q->count = v[2];
        q->inverted = v[3];
        q->offset = v[4];
    }
}

static void read_symbol(struct reader *r, const char *text)
{
    struct symbol *s;
    const char *name, *comment;
    if(text[0] == '#' || r->item >= r->l->sizes.symbols) return;
    name = strchr(text, ',');
    comment = name ? strchr(name + 1, ',') : NULL;
    if(!name) {
        fail(r, "expected variable,symbol,comment", text);
        return;
    }
    s = &LADDER(r->l, symbols, struct symbol)[r->item++];
    copy(s->variable, VAR_NAME_LEN, text, ",");
    copy(s->name, SYMBOL_LEN, name + 1, ",");
    if(comment) copy(s->comment, SYMBOL_COMMENT_LEN, comment + 1, "");
}

/* Readers that want their # lines set `marks`. */
static const struct part {
    const char *name;
    void (*read)(struct reader *, const char *);
    int marks;
} parts[] = {
    { "general.txt", read_general, 0 }, { "com_params.txt", read_com_params, 0 },
    { "timers.csv", read_timers, 0 }, { "monostables.csv", read_monostables, 0 },
    { "counters.csv", read_counters, 0 }, { "timers_iec.csv", read_timers_iec, 0 },
    { "arithmetic_expressions.csv", read_expression, 0 }, { "sections.csv", read_section, 1 },
    { "sequential.csv", read_sequential, 0 }, { "modbusioconf.csv", read_modbus_request, 0 },
    { "symbols.csv", read_symbol, 0 },
};
static const struct part rung_part = { "rung_", read_rung, 1 };

/* The part with a file name, or NULL; sets the rung's number. */
static const struct part *find_part(struct reader *r, const char *name)
{
    size_t i;
    r->item = 0;
    for(i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if(!strcmp(name, parts[i].name)) return &parts[i];
    if(!strncmp(name, rung_part.name, 5) && isdigit((unsigned char)name[5])) {
        r->rung = atoi(name + 5);
        return &rung_part;
    }
    return NULL;
}

static void read_line(struct reader *r, const struct part *part, const char *text)
{
    if(text[0] == 0 || text[0] == ';') return;
    if(text[0] == '#' && !part->marks && strchr(text, '=')) return;
    part->read(r, text);
}

/* Reads the lines of a stream; part: the one that they belong to, NULL for a .clp file. */
static void read_lines(struct reader *r, FILE *f, const struct part *part)
{
    char line[LINE_LEN];
    int bundle = part == NULL;
    r->line = 0;
    while(!r->failed && fgets(line, sizeof line, f)) {
        r->line++;
        line[strcspn(line, "\r\n")] = 0;
        if(bundle && r->line == 1 && strcmp(line, "_FILES_CLASSICLADDER")) {
            fail(r, "not a ladder project, expected _FILES_CLASSICLADDER", line);
        } else if(bundle && !strncmp(line, "_FILE-", 6)) {
            part = find_part(r, line + 6);
        } else if(bundle && (!strncmp(line, "_/FILE-", 7) || !strcmp(line, "_/FILES_CLASSICLADDER"))) {
            part = NULL;
        } else if(part) {
            read_line(r, part, line);
        }
    }
    if(bundle && !r->failed && r->line == 0) fail(r, "empty file", "");
}

static int read_file(struct reader *r, const char *path, const char *part_name)
{
    FILE *f = fopen(path, "r");
    if(!f) {
        snprintf(r->message, CLP_MESSAGE, "%.100s: %s", path, strerror(errno));
        r->failed = 1;
        return -1;
    }
    r->file = path;
    if(!part_name) {
        read_lines(r, f, NULL);
    } else {
        const struct part *part = find_part(r, part_name);
        if(part) read_lines(r, f, part);
    }
    fclose(f);
    return r->failed ? -1 : 0;
}

static int read_folder(struct reader *r, const char *path)
{
    struct dirent *entry;
    DIR *folder = opendir(path);
    if(!folder) {
        snprintf(r->message, CLP_MESSAGE, "%.100s: %s", path, strerror(errno));
        return -1;
    }
    while(!r->failed && (entry = readdir(folder))) {
        char file[LINE_LEN];
        if(entry->d_name[0] == '.') continue;
        snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
        read_file(r, file, entry->d_name);
    }
    closedir(folder);
    return r->failed ? -1 : 0;
}

/* ---- The program as a whole ------------------------------------------------ */

/* Compiles expressions as what the cells use them for. */
static int compile(struct reader *r)
{
    struct ladder *l = r->l;
    struct expression *e = LADDER(l, expressions, struct expression);
    int n, x, y, i;
    for(i = 0; i < l->sizes.expressions; i++) ladder_compile(&e[i], strstr(e[i].text, ":=") != NULL);
    for(n = 0; n < l->sizes.rungs; n++) {
        const struct rung *rung = &LADDER(l, rungs, struct rung)[n];
        for(y = 0; rung->used && y < RUNG_HEIGHT; y++) {
            for(x = 0; x < RUNG_WIDTH; x++) {
                const struct cell *c = &rung->cell[y][x];
                if(c->type != EL_COMPARE && c->type != EL_OPERATE) continue;
                i = c->var.number;
                if(i < 0 || i >= l->sizes.expressions) continue;
                ladder_compile(&e[i], c->type == EL_OPERATE);
                if(e[i].valid) continue;
                snprintf(r->message, CLP_MESSAGE, "%.100s: rung %d: cannot read the expression \"%s\" as %s", r->file,
                         n, e[i].text, c->type == EL_OPERATE ? "@type/number@ := value" : "a comparison");
                return -1;
            }
        }
    }
    return 0;
}

int clp_read(struct ladder *l, const char *path, char message[CLP_MESSAGE])
{
    struct reader r = { .l = l, .file = path, .message = message };
    struct stat info;
    int folder = stat(path, &info) == 0 && S_ISDIR(info.st_mode), result;
    message[0] = 0;
    ladder_clear(l);
    result = folder ? read_folder(&r, path) : read_file(&r, path, NULL);
    r.file = path;
    if(result == 0) result = compile(&r);
    if(result < 0) ladder_clear(l);
    ladder_reset(l);
    return result;
}
