/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_eth_net.c - the network around a board: socket, interface, hardware address, firewall. [init]
 */
#include <arpa/inet.h>
#include <errno.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include "hm2_eth.h"

#define CHAIN "hm2-eth-rules-output"
#define TABLE "inet hm2_eth"
#define MAX_WORDS 32

/* ---- Socket ----------------------------------------------------------------- */

/* The interface that has our end's address. */
static void find_interface(struct eth_board *b)
{
    struct ifaddrs *list, *a;
    if(getifaddrs(&list) < 0) return;
    for(a = list; a; a = a->ifa_next) {
        if(!a->ifa_addr || a->ifa_addr->sa_family != AF_INET) continue;
        if(((struct sockaddr_in *)(void *)a->ifa_addr)->sin_addr.s_addr != b->local.sin_addr.s_addr) continue;
        snprintf(b->interface, sizeof b->interface, "%s", a->ifa_name);
    }
    freeifaddrs(list);
}

int eth_open(struct eth_board *b)
{
    socklen_t size = sizeof b->local;
    const char *what = "socket";
    b->remote.sin_family = AF_INET;
    b->remote.sin_port = htons(ETH_PORT);
    if(inet_pton(AF_INET, b->ip, &b->remote.sin_addr) != 1) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: board_ip=%s is no address like 192.168.1.121\n", b->ip);
        return -EINVAL;
    }
    b->fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if(b->fd < 0) goto failed;
    what = "connect";
    if(connect(b->fd, (struct sockaddr *)&b->remote, sizeof b->remote) < 0) goto failed;
    what = "getsockname";
    if(getsockname(b->fd, (struct sockaddr *)&b->local, &size) < 0) goto failed;
    b->loopback = ntohl(b->remote.sin_addr.s_addr) >> 24 == 127;
    find_interface(b);
    return 0;
failed:;
    int error = errno;
    rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: %s to %s: %s (is the network interface up, and does it have an "
                    "address in the board's network?)\n", what, b->ip, strerror(error));
    return -error;
}

/* ---- Hardware address ------------------------------------------------------- */

static int arp_request(struct eth_board *b, unsigned long what)
{
    struct arpreq request = {0};
    memcpy(&request.arp_pa, &b->remote, sizeof b->remote);
    memcpy(request.arp_ha.sa_data, b->mac, sizeof b->mac);
    request.arp_ha.sa_family = ARPHRD_ETHER;
    request.arp_flags = ATF_PERM | ATF_COM;
    memcpy(request.arp_dev, b->interface, sizeof request.arp_dev - 1);
    return ioctl(b->fd, what, &request);
}

void eth_set_arp(struct eth_board *b)
{
    if(b->loopback) return;
    b->arp_set = arp_request(b, SIOCSARP) == 0;
    if(!b->arp_set)
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "hm2_eth: WARNING: cannot fix the hardware address of %s (%s): a packet is late "
                        "now and then; `sudo make setcap` gives the right\n", b->ip, strerror(errno));
}

void eth_close(struct eth_board *b)
{
    if(b->fd < 0) return;
    if(b->arp_set) arp_request(b, SIOCDARP);
    close(b->fd);
    b->fd = -1;
}

/* ---- Firewall --------------------------------------------------------------- */

enum firewall { FIREWALL_NONE, FIREWALL_IPTABLES, FIREWALL_NFT };
static enum firewall active;

/* Runs a command, given as words; quiet throws away what it says. 0: it ended well. */
static int run(bool quiet, const char *format, ...) __attribute__((format(printf, 2, 3)));
static int run(bool quiet, const char *format, ...)
{
    extern char **environ;
    char text[400], *argv[MAX_WORDS + 1], *at, *save;
    posix_spawn_file_actions_t actions;
    int n = 0, status = -1, r;
    pid_t pid;
    va_list ap;
    va_start(ap, format);
    rtapi_vsnprintf(text, sizeof text, format, ap);
    va_end(ap);
    for(at = strtok_r(text, " ", &save); at && n < MAX_WORDS; at = strtok_r(NULL, " ", &save)) argv[n++] = at;
    argv[n] = NULL;
    posix_spawn_file_actions_init(&actions);
    if(quiet) {
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
    }
    r = rtapi_spawnp_as_root(&pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if(r != 0) return -1;
    while(waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : -1;
}

static bool iptables_usable(void)
{
    return run(true, "iptables -n -L OUTPUT") == 0;
}

static bool nft_usable(void)
{
    return run(true, "nft list tables") == 0;
}

static enum firewall choose(const char *how)
{
    if(!strcmp(how, "none")) return FIREWALL_NONE;
    if(!strcmp(how, "auto"))
        return iptables_usable() ? FIREWALL_IPTABLES : nft_usable() ? FIREWALL_NFT : FIREWALL_NONE;
    if(!strcmp(how, "iptables")) return iptables_usable() ? FIREWALL_IPTABLES : FIREWALL_NONE;
    if(!strcmp(how, "nft") || !strcmp(how, "nftables")) return nft_usable() ? FIREWALL_NFT : FIREWALL_NONE;
    rtapi_print_msg(RTAPI_MSG_ERR, "hm2_eth: ERROR: firewall=%s: there are auto, iptables, nft and none\n", how);
    return FIREWALL_NONE;
}

/* What a rule for a board needs, as text. */
struct ends {
    char local[INET_ADDRSTRLEN], remote[INET_ADDRSTRLEN];
    int local_port;
};

static struct ends ends_of(const struct eth_board *b)
{
    struct ends e;
    inet_ntop(AF_INET, &b->local.sin_addr, e.local, sizeof e.local);
    inet_ntop(AF_INET, &b->remote.sin_addr, e.remote, sizeof e.remote);
    e.local_port = ntohs(b->local.sin_port);
    return e;
}

static bool interface_seen(struct eth_board *const *boards, int i)
{
    int k;
    for(k = 0; k < i; k++)
        if(!strcmp(boards[k]->interface, boards[i]->interface)) return true;
    return !boards[i]->interface[0];
}

static int start_iptables(struct eth_board *const *boards, int n)
{
    static const char *const programs[] = {"iptables", "ip6tables"};
    int i, p, r = 0;
    for(p = 0; p < 2; p++) {
        run(true, "%s -N " CHAIN, programs[p]);
        r |= run(false, "%s -F " CHAIN, programs[p]);
        if(run(true, "%s -C OUTPUT -j " CHAIN, programs[p]) < 0)
            r |= run(false, "%s -I OUTPUT 1 -j " CHAIN, programs[p]);
    }
    for(i = 0; i < n; i++) {
        struct ends e = ends_of(boards[i]);
        r |= run(false, "iptables -A " CHAIN " -p udp -m udp -d %s --dport %d -s %s --sport %d -j ACCEPT", e.remote,
                 ETH_PORT, e.local, e.local_port);
    }
    for(i = 0; i < n; i++) {
        if(interface_seen(boards, i)) continue;
        r |= run(false, "iptables -A " CHAIN " -o %s -p icmp -j DROP", boards[i]->interface);
        r |= run(false, "iptables -A " CHAIN " -o %s -j REJECT --reject-with icmp-admin-prohibited",
                 boards[i]->interface);
        r |= run(false, "ip6tables -A " CHAIN " -o %s -j DROP", boards[i]->interface);
    }
    return r;
}

static int start_nft(struct eth_board *const *boards, int n)
{
    int i, r;
    run(true, "nft delete table " TABLE);
    r = run(false, "nft add table " TABLE);
    r |= run(false, "nft add chain " TABLE " output { type filter hook output priority 0 ; policy accept ; }");
    for(i = 0; i < n; i++) {
        struct ends e = ends_of(boards[i]);
        r |= run(false, "nft add rule " TABLE " output ip daddr %s udp dport %d ip saddr %s udp sport %d accept",
                 e.remote,
                 ETH_PORT, e.local, e.local_port);
    }
    for(i = 0; i < n; i++) {
        if(interface_seen(boards, i)) continue;
        r |= run(false, "nft add rule " TABLE " output oifname %s ip protocol icmp drop", boards[i]->interface);
        r |= run(false, "nft add rule " TABLE " output oifname %s meta nfproto ipv6 drop", boards[i]->interface);
        r |= run(false, "nft add rule " TABLE " output oifname %s reject with icmpx type admin-prohibited",
                 boards[i]->interface);
    }
    return r;
}

/* On the computer's own loopback the rules would cut off everything else: only when asked for. */
static bool only_loopback(struct eth_board *const *boards, int n)
{
    int i;
    for(i = 0; i < n; i++)
        if(!boards[i]->loopback) return false;
    return true;
}

void eth_firewall_start(const char *how, struct eth_board *const *boards, int n)
{
    if(!n || (!strcmp(how, "auto") && only_loopback(boards, n))) return;
    active = choose(how);
    if(active == FIREWALL_IPTABLES && start_iptables(boards, n) == 0) return;
    if(active == FIREWALL_NFT && start_nft(boards, n) == 0) return;
    if(strcmp(how, "none"))
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "hm2_eth: WARNING: Unable to restrict other access to the boards' network: keep "
                        "other programs off it yourself\n");
}

void eth_firewall_stop(void)
{
    if(active == FIREWALL_IPTABLES) {
        run(true, "iptables -F " CHAIN);
        run(true, "ip6tables -F " CHAIN);
    }
    if(active == FIREWALL_NFT) run(true, "nft delete table " TABLE);
    active = FIREWALL_NONE;
}
