component marked;
pin in bit a;
pin out bit b = FALSE "ünïcode";
function _;
license "GPL";
;;
b = !a;
