import oword
import remap
