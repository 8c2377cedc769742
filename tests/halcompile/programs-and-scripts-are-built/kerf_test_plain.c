#include <stdio.h>

int main(void)
{
    puts("plain program");
    return 0;
}
