"""The parser made from grammar/OpenSCENARIO2.g4 by `make parser`; not to be edited."""
from __future__ import annotations

from typing import Final

from osc2tx.syntax.parser_runtime import (
    Network,
    NoViableAltException,
    Parser,
    ParserRuleContext,
    RecognitionException,
)

def serializedATN() -> list[int]:
    return [
        4,1,84,695,2,0,7,0,2,1,7,1,2,2,7,2,2,3,7,3,2,4,7,4,2,5,7,5,2,6,7,
        6,2,7,7,7,2,8,7,8,2,9,7,9,2,10,7,10,2,11,7,11,2,12,7,12,2,13,7,13,
        2,14,7,14,2,15,7,15,2,16,7,16,2,17,7,17,2,18,7,18,2,19,7,19,2,20,
        7,20,2,21,7,21,2,22,7,22,2,23,7,23,2,24,7,24,2,25,7,25,2,26,7,26,
        2,27,7,27,2,28,7,28,2,29,7,29,2,30,7,30,2,31,7,31,2,32,7,32,2,33,
        7,33,2,34,7,34,2,35,7,35,2,36,7,36,2,37,7,37,2,38,7,38,2,39,7,39,
        2,40,7,40,2,41,7,41,2,42,7,42,2,43,7,43,2,44,7,44,2,45,7,45,2,46,
        7,46,2,47,7,47,2,48,7,48,2,49,7,49,1,0,3,0,102,8,0,1,0,5,0,105,8,
        0,10,0,12,0,108,9,0,1,0,1,0,1,1,1,1,5,1,114,8,1,10,1,12,1,117,9,
        1,1,1,1,1,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,
        2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2,3,2,149,
        8,2,1,3,3,3,152,8,3,1,3,1,3,3,3,156,8,3,1,4,1,4,3,4,160,8,4,1,4,
        1,4,3,4,164,8,4,1,4,3,4,167,8,4,1,5,1,5,1,5,3,5,172,8,5,1,5,1,5,
        3,5,176,8,5,1,6,1,6,1,6,5,6,181,8,6,10,6,12,6,184,9,6,1,7,1,7,1,
        7,1,7,1,7,1,7,5,7,192,8,7,10,7,12,7,195,9,7,3,7,197,8,7,1,7,1,7,
        3,7,201,8,7,1,8,1,8,1,8,1,8,5,8,207,8,8,10,8,12,8,210,9,8,1,8,1,
        8,3,8,214,8,8,1,9,1,9,1,9,1,9,5,9,220,8,9,10,9,12,9,223,9,9,1,9,
        1,9,3,9,227,8,9,1,10,1,10,1,11,1,11,1,11,1,12,1,12,5,12,236,8,12,
        10,12,12,12,239,9,12,1,12,1,12,1,13,1,13,1,13,3,13,246,8,13,1,14,
        1,14,1,14,1,14,1,14,1,14,3,14,254,8,14,1,15,1,15,1,15,1,15,1,15,
        1,15,1,15,1,15,3,15,264,8,15,1,16,1,16,1,16,3,16,269,8,16,1,16,1,
        16,1,17,1,17,1,17,1,17,1,17,1,17,3,17,279,8,17,1,18,1,18,1,18,1,
        18,5,18,285,8,18,10,18,12,18,288,9,18,1,18,1,18,1,19,1,19,1,19,3,
        19,295,8,19,1,20,1,20,1,20,3,20,300,8,20,1,20,1,20,1,21,1,21,1,21,
        3,21,307,8,21,1,21,1,21,1,22,1,22,1,22,3,22,314,8,22,1,22,1,22,1,
        23,1,23,1,23,3,23,321,8,23,1,23,1,23,1,24,1,24,1,24,1,24,3,24,329,
        8,24,1,24,1,24,1,25,1,25,1,25,1,25,1,25,1,25,3,25,339,8,25,1,26,
        1,26,1,26,3,26,344,8,26,1,26,3,26,347,8,26,1,26,1,26,3,26,351,8,
        26,1,27,1,27,1,27,1,27,3,27,357,8,27,1,27,3,27,360,8,27,1,27,1,27,
        3,27,364,8,27,1,27,1,27,3,27,368,8,27,1,28,1,28,1,28,5,28,373,8,
        28,10,28,12,28,376,9,28,1,29,1,29,1,29,1,29,1,29,3,29,383,8,29,1,
        30,3,30,386,8,30,1,30,1,30,1,30,3,30,391,8,30,1,30,1,30,3,30,395,
        8,30,1,31,1,31,1,31,1,31,5,31,401,8,31,10,31,12,31,404,9,31,1,31,
        1,31,1,31,1,31,1,31,3,31,411,8,31,3,31,413,8,31,1,31,1,31,1,32,1,
        32,1,32,1,32,1,32,1,32,1,32,3,32,424,8,32,1,32,1,32,1,33,1,33,1,
        33,1,33,3,33,432,8,33,1,33,1,33,1,33,3,33,437,8,33,1,33,1,33,3,33,
        441,8,33,1,33,1,33,1,33,1,33,1,33,1,33,1,33,3,33,450,8,33,1,33,1,
        33,3,33,454,8,33,1,33,1,33,3,33,458,8,33,1,34,1,34,1,34,3,34,463,
        8,34,1,34,1,34,1,34,1,34,3,34,469,8,34,1,35,1,35,1,35,1,35,1,35,
        1,35,3,35,477,8,35,1,36,1,36,1,36,3,36,482,8,36,1,36,1,36,1,36,3,
        36,487,8,36,1,37,1,37,1,37,5,37,492,8,37,10,37,12,37,495,9,37,1,
        37,1,37,1,37,1,37,1,37,1,37,3,37,503,8,37,1,37,3,37,506,8,37,1,38,
        1,38,4,38,510,8,38,11,38,12,38,511,1,38,1,38,3,38,516,8,38,1,38,
        1,38,3,38,520,8,38,1,38,1,38,1,39,1,39,1,39,3,39,527,8,39,1,39,3,
        39,530,8,39,3,39,532,8,39,1,40,1,40,1,40,1,40,1,41,1,41,1,41,1,41,
        3,41,542,8,41,1,41,3,41,545,8,41,1,41,1,41,1,41,1,41,1,41,3,41,552,
        8,41,1,42,1,42,1,42,3,42,557,8,42,1,42,3,42,560,8,42,1,42,3,42,563,
        8,42,1,42,1,42,3,42,567,8,42,1,42,3,42,570,8,42,1,43,1,43,1,43,1,
        43,3,43,576,8,43,1,44,1,44,1,44,1,44,3,44,582,8,44,1,45,1,45,1,45,
        1,45,3,45,588,8,45,1,46,1,46,1,46,1,46,3,46,594,8,46,1,47,5,47,597,
        8,47,10,47,12,47,600,9,47,1,47,1,47,1,47,1,47,1,47,1,47,3,47,608,
        8,47,1,47,1,47,1,47,1,47,1,47,1,47,1,47,3,47,617,8,47,1,47,1,47,
        1,47,1,47,1,47,1,47,1,47,1,47,3,47,627,8,47,1,47,1,47,1,47,5,47,
        632,8,47,10,47,12,47,635,9,47,1,47,1,47,1,47,1,47,1,47,1,47,3,47,
        643,8,47,5,47,645,8,47,10,47,12,47,648,9,47,1,47,1,47,1,47,1,47,
        1,47,3,47,655,8,47,1,48,1,48,1,48,1,48,1,48,1,48,1,48,1,48,1,48,
        1,48,5,48,667,8,48,10,48,12,48,670,9,48,3,48,672,8,48,3,48,674,8,
        48,1,48,3,48,677,8,48,1,49,1,49,1,49,3,49,682,8,49,1,49,1,49,1,49,
        1,49,3,49,688,8,49,5,49,690,8,49,10,49,12,49,693,9,49,1,49,0,0,50,
        0,2,4,6,8,10,12,14,16,18,20,22,24,26,28,30,32,34,36,38,40,42,44,
        46,48,50,52,54,56,58,60,62,64,66,68,70,72,74,76,78,80,82,84,86,88,
        90,92,94,96,98,0,8,3,0,4,4,9,9,82,82,1,0,41,42,1,0,34,35,1,0,32,
        33,1,0,45,47,2,0,57,57,80,81,2,0,26,26,53,53,3,0,55,56,58,58,73,
        84,786,0,101,1,0,0,0,2,111,1,0,0,0,4,148,1,0,0,0,6,151,1,0,0,0,8,
        157,1,0,0,0,10,168,1,0,0,0,12,177,1,0,0,0,14,185,1,0,0,0,16,202,
        1,0,0,0,18,215,1,0,0,0,20,228,1,0,0,0,22,230,1,0,0,0,24,237,1,0,
        0,0,26,242,1,0,0,0,28,247,1,0,0,0,30,255,1,0,0,0,32,265,1,0,0,0,
        34,272,1,0,0,0,36,280,1,0,0,0,38,291,1,0,0,0,40,296,1,0,0,0,42,303,
        1,0,0,0,44,310,1,0,0,0,46,317,1,0,0,0,48,324,1,0,0,0,50,332,1,0,
        0,0,52,340,1,0,0,0,54,352,1,0,0,0,56,369,1,0,0,0,58,377,1,0,0,0,
        60,385,1,0,0,0,62,396,1,0,0,0,64,416,1,0,0,0,66,427,1,0,0,0,68,459,
        1,0,0,0,70,470,1,0,0,0,72,478,1,0,0,0,74,488,1,0,0,0,76,515,1,0,
        0,0,78,531,1,0,0,0,80,533,1,0,0,0,82,537,1,0,0,0,84,553,1,0,0,0,
        86,571,1,0,0,0,88,577,1,0,0,0,90,583,1,0,0,0,92,589,1,0,0,0,94,598,
        1,0,0,0,96,676,1,0,0,0,98,678,1,0,0,0,100,102,3,2,1,0,101,100,1,
        0,0,0,101,102,1,0,0,0,102,106,1,0,0,0,103,105,3,4,2,0,104,103,1,
        0,0,0,105,108,1,0,0,0,106,104,1,0,0,0,106,107,1,0,0,0,107,109,1,
        0,0,0,108,106,1,0,0,0,109,110,5,0,0,1,110,1,1,0,0,0,111,115,5,2,
        0,0,112,114,3,4,2,0,113,112,1,0,0,0,114,117,1,0,0,0,115,113,1,0,
        0,0,115,116,1,0,0,0,116,118,1,0,0,0,117,115,1,0,0,0,118,119,5,3,
        0,0,119,3,1,0,0,0,120,149,3,74,37,0,121,149,3,84,42,0,122,149,3,
        86,43,0,123,149,3,68,34,0,124,149,3,62,31,0,125,149,3,54,27,0,126,
        149,3,66,33,0,127,149,3,88,44,0,128,149,3,90,45,0,129,149,3,92,46,
        0,130,149,3,80,40,0,131,149,3,82,41,0,132,149,3,40,20,0,133,149,
        3,42,21,0,134,149,3,44,22,0,135,149,3,46,23,0,136,149,3,48,24,0,
        137,149,3,34,17,0,138,149,3,30,15,0,139,149,3,28,14,0,140,149,3,
        52,26,0,141,149,3,22,11,0,142,149,3,70,35,0,143,149,3,72,36,0,144,
        149,3,10,5,0,145,149,3,14,7,0,146,149,3,16,8,0,147,149,3,18,9,0,
        148,120,1,0,0,0,148,121,1,0,0,0,148,122,1,0,0,0,148,123,1,0,0,0,
        148,124,1,0,0,0,148,125,1,0,0,0,148,126,1,0,0,0,148,127,1,0,0,0,
        148,128,1,0,0,0,148,129,1,0,0,0,148,130,1,0,0,0,148,131,1,0,0,0,
        148,132,1,0,0,0,148,133,1,0,0,0,148,134,1,0,0,0,148,135,1,0,0,0,
        148,136,1,0,0,0,148,137,1,0,0,0,148,138,1,0,0,0,148,139,1,0,0,0,
        148,140,1,0,0,0,148,141,1,0,0,0,148,142,1,0,0,0,148,143,1,0,0,0,
        148,144,1,0,0,0,148,145,1,0,0,0,148,146,1,0,0,0,148,147,1,0,0,0,
        149,5,1,0,0,0,150,152,5,59,0,0,151,150,1,0,0,0,151,152,1,0,0,0,152,
        153,1,0,0,0,153,155,5,1,0,0,154,156,3,2,1,0,155,154,1,0,0,0,155,
        156,1,0,0,0,156,7,1,0,0,0,157,159,5,52,0,0,158,160,5,59,0,0,159,
        158,1,0,0,0,159,160,1,0,0,0,160,166,1,0,0,0,161,163,5,1,0,0,162,
        164,3,2,1,0,163,162,1,0,0,0,163,164,1,0,0,0,164,167,1,0,0,0,165,
        167,3,4,2,0,166,161,1,0,0,0,166,165,1,0,0,0,167,9,1,0,0,0,168,171,
        5,10,0,0,169,172,5,8,0,0,170,172,3,12,6,0,171,169,1,0,0,0,171,170,
        1,0,0,0,172,173,1,0,0,0,173,175,5,1,0,0,174,176,3,2,1,0,175,174,
        1,0,0,0,175,176,1,0,0,0,176,11,1,0,0,0,177,182,5,4,0,0,178,179,5,
        61,0,0,179,181,5,4,0,0,180,178,1,0,0,0,181,184,1,0,0,0,182,180,1,
        0,0,0,182,183,1,0,0,0,183,13,1,0,0,0,184,182,1,0,0,0,185,186,5,11,
        0,0,186,196,5,4,0,0,187,188,5,12,0,0,188,193,3,12,6,0,189,190,5,
        60,0,0,190,192,3,12,6,0,191,189,1,0,0,0,192,195,1,0,0,0,193,191,
        1,0,0,0,193,194,1,0,0,0,194,197,1,0,0,0,195,193,1,0,0,0,196,187,
        1,0,0,0,196,197,1,0,0,0,197,198,1,0,0,0,198,200,5,1,0,0,199,201,
        3,2,1,0,200,199,1,0,0,0,200,201,1,0,0,0,201,15,1,0,0,0,202,203,5,
        12,0,0,203,208,3,12,6,0,204,205,5,60,0,0,205,207,3,12,6,0,206,204,
        1,0,0,0,207,210,1,0,0,0,208,206,1,0,0,0,208,209,1,0,0,0,209,211,
        1,0,0,0,210,208,1,0,0,0,211,213,5,1,0,0,212,214,3,2,1,0,213,212,
        1,0,0,0,213,214,1,0,0,0,214,17,1,0,0,0,215,216,5,13,0,0,216,221,
        3,20,10,0,217,218,5,60,0,0,218,220,3,20,10,0,219,217,1,0,0,0,220,
        223,1,0,0,0,221,219,1,0,0,0,221,222,1,0,0,0,222,224,1,0,0,0,223,
        221,1,0,0,0,224,226,5,1,0,0,225,227,3,2,1,0,226,225,1,0,0,0,226,
        227,1,0,0,0,227,19,1,0,0,0,228,229,7,0,0,0,229,21,1,0,0,0,230,231,
        5,23,0,0,231,232,3,74,37,0,232,23,1,0,0,0,233,234,7,1,0,0,234,236,
        5,25,0,0,235,233,1,0,0,0,236,239,1,0,0,0,237,235,1,0,0,0,237,238,
        1,0,0,0,238,240,1,0,0,0,239,237,1,0,0,0,240,241,3,26,13,0,241,25,
        1,0,0,0,242,245,5,4,0,0,243,244,5,61,0,0,244,246,5,4,0,0,245,243,
        1,0,0,0,245,246,1,0,0,0,246,27,1,0,0,0,247,248,5,14,0,0,248,249,
        5,4,0,0,249,250,5,26,0,0,250,251,3,32,16,0,251,253,5,1,0,0,252,254,
        3,2,1,0,253,252,1,0,0,0,253,254,1,0,0,0,254,29,1,0,0,0,255,256,5,
        15,0,0,256,257,5,4,0,0,257,258,5,25,0,0,258,259,5,4,0,0,259,260,
        5,26,0,0,260,261,3,32,16,0,261,263,5,1,0,0,262,264,3,2,1,0,263,262,
        1,0,0,0,263,264,1,0,0,0,264,31,1,0,0,0,265,266,5,4,0,0,266,268,5,
        69,0,0,267,269,3,98,49,0,268,267,1,0,0,0,268,269,1,0,0,0,269,270,
        1,0,0,0,270,271,5,70,0,0,271,33,1,0,0,0,272,273,5,16,0,0,273,274,
        5,4,0,0,274,275,5,59,0,0,275,276,3,36,18,0,276,278,5,1,0,0,277,279,
        3,2,1,0,278,277,1,0,0,0,278,279,1,0,0,0,279,35,1,0,0,0,280,281,5,
        71,0,0,281,286,3,38,19,0,282,283,5,60,0,0,283,285,3,38,19,0,284,
        282,1,0,0,0,285,288,1,0,0,0,286,284,1,0,0,0,286,287,1,0,0,0,287,
        289,1,0,0,0,288,286,1,0,0,0,289,290,5,72,0,0,290,37,1,0,0,0,291,
        294,5,4,0,0,292,293,5,63,0,0,293,295,3,94,47,0,294,292,1,0,0,0,294,
        295,1,0,0,0,295,39,1,0,0,0,296,297,5,17,0,0,297,299,3,26,13,0,298,
        300,3,50,25,0,299,298,1,0,0,0,299,300,1,0,0,0,300,301,1,0,0,0,301,
        302,3,6,3,0,302,41,1,0,0,0,303,304,5,18,0,0,304,306,3,26,13,0,305,
        307,3,50,25,0,306,305,1,0,0,0,306,307,1,0,0,0,307,308,1,0,0,0,308,
        309,3,6,3,0,309,43,1,0,0,0,310,311,5,19,0,0,311,313,3,26,13,0,312,
        314,3,50,25,0,313,312,1,0,0,0,313,314,1,0,0,0,314,315,1,0,0,0,315,
        316,3,6,3,0,316,45,1,0,0,0,317,318,5,20,0,0,318,320,3,26,13,0,319,
        321,3,50,25,0,320,319,1,0,0,0,320,321,1,0,0,0,321,322,1,0,0,0,322,
        323,3,6,3,0,323,47,1,0,0,0,324,325,5,21,0,0,325,328,3,26,13,0,326,
        327,5,25,0,0,327,329,3,26,13,0,328,326,1,0,0,0,328,329,1,0,0,0,329,
        330,1,0,0,0,330,331,3,6,3,0,331,49,1,0,0,0,332,333,5,24,0,0,333,
        338,3,26,13,0,334,335,5,69,0,0,335,336,3,94,47,0,336,337,5,70,0,
        0,337,339,1,0,0,0,338,334,1,0,0,0,338,339,1,0,0,0,339,51,1,0,0,0,
        340,341,5,22,0,0,341,343,3,26,13,0,342,344,5,59,0,0,343,342,1,0,
        0,0,343,344,1,0,0,0,344,346,1,0,0,0,345,347,3,36,18,0,346,345,1,
        0,0,0,346,347,1,0,0,0,347,348,1,0,0,0,348,350,5,1,0,0,349,351,3,
        2,1,0,350,349,1,0,0,0,350,351,1,0,0,0,351,53,1,0,0,0,352,353,5,27,
        0,0,353,359,5,4,0,0,354,356,5,69,0,0,355,357,3,56,28,0,356,355,1,
        0,0,0,356,357,1,0,0,0,357,358,1,0,0,0,358,360,5,70,0,0,359,354,1,
        0,0,0,359,360,1,0,0,0,360,363,1,0,0,0,361,362,5,26,0,0,362,364,3,
        60,30,0,363,361,1,0,0,0,363,364,1,0,0,0,364,365,1,0,0,0,365,367,
        5,1,0,0,366,368,3,2,1,0,367,366,1,0,0,0,367,368,1,0,0,0,368,55,1,
        0,0,0,369,374,3,58,29,0,370,371,5,60,0,0,371,373,3,58,29,0,372,370,
        1,0,0,0,373,376,1,0,0,0,374,372,1,0,0,0,374,375,1,0,0,0,375,57,1,
        0,0,0,376,374,1,0,0,0,377,378,5,4,0,0,378,379,5,59,0,0,379,382,3,
        24,12,0,380,381,5,63,0,0,381,383,3,94,47,0,382,380,1,0,0,0,382,383,
        1,0,0,0,383,59,1,0,0,0,384,386,5,64,0,0,385,384,1,0,0,0,385,386,
        1,0,0,0,386,387,1,0,0,0,387,390,3,94,47,0,388,389,5,53,0,0,389,391,
        5,4,0,0,390,388,1,0,0,0,390,391,1,0,0,0,391,394,1,0,0,0,392,393,
        5,54,0,0,393,395,3,94,47,0,394,392,1,0,0,0,394,395,1,0,0,0,395,61,
        1,0,0,0,396,397,5,28,0,0,397,402,5,4,0,0,398,399,5,60,0,0,399,401,
        5,4,0,0,400,398,1,0,0,0,401,404,1,0,0,0,402,400,1,0,0,0,402,403,
        1,0,0,0,403,405,1,0,0,0,404,402,1,0,0,0,405,406,5,59,0,0,406,412,
        3,24,12,0,407,410,5,63,0,0,408,411,3,64,32,0,409,411,3,94,47,0,410,
        408,1,0,0,0,410,409,1,0,0,0,411,413,1,0,0,0,412,407,1,0,0,0,412,
        413,1,0,0,0,413,414,1,0,0,0,414,415,3,78,39,0,415,63,1,0,0,0,416,
        417,5,40,0,0,417,418,5,69,0,0,418,419,3,94,47,0,419,420,5,60,0,0,
        420,423,3,60,30,0,421,422,5,60,0,0,422,424,3,94,47,0,423,421,1,0,
        0,0,423,424,1,0,0,0,424,425,1,0,0,0,425,426,5,70,0,0,426,65,1,0,
        0,0,427,428,5,29,0,0,428,429,5,4,0,0,429,431,5,69,0,0,430,432,3,
        56,28,0,431,430,1,0,0,0,431,432,1,0,0,0,432,433,1,0,0,0,433,436,
        5,70,0,0,434,435,5,65,0,0,435,437,3,24,12,0,436,434,1,0,0,0,436,
        437,1,0,0,0,437,438,1,0,0,0,438,440,5,26,0,0,439,441,5,36,0,0,440,
        439,1,0,0,0,440,441,1,0,0,0,441,453,1,0,0,0,442,443,5,37,0,0,443,
        454,3,94,47,0,444,454,5,38,0,0,445,446,5,39,0,0,446,447,3,12,6,0,
        447,449,5,69,0,0,448,450,3,98,49,0,449,448,1,0,0,0,449,450,1,0,0,
        0,450,451,1,0,0,0,451,452,5,70,0,0,452,454,1,0,0,0,453,442,1,0,0,
        0,453,444,1,0,0,0,453,445,1,0,0,0,454,455,1,0,0,0,455,457,5,1,0,
        0,456,458,3,2,1,0,457,456,1,0,0,0,457,458,1,0,0,0,458,67,1,0,0,0,
        459,460,5,30,0,0,460,462,5,69,0,0,461,463,7,2,0,0,462,461,1,0,0,
        0,462,463,1,0,0,0,463,464,1,0,0,0,464,465,3,94,47,0,465,466,5,70,
        0,0,466,468,5,1,0,0,467,469,3,2,1,0,468,467,1,0,0,0,468,469,1,0,
        0,0,469,69,1,0,0,0,470,471,5,31,0,0,471,472,5,69,0,0,472,473,3,94,
        47,0,473,474,5,70,0,0,474,476,5,1,0,0,475,477,3,2,1,0,476,475,1,
        0,0,0,476,477,1,0,0,0,477,71,1,0,0,0,478,479,7,3,0,0,479,481,5,69,
        0,0,480,482,3,98,49,0,481,480,1,0,0,0,481,482,1,0,0,0,482,483,1,
        0,0,0,483,484,5,70,0,0,484,486,5,1,0,0,485,487,3,2,1,0,486,485,1,
        0,0,0,486,487,1,0,0,0,487,73,1,0,0,0,488,493,3,94,47,0,489,490,5,
        60,0,0,490,492,3,94,47,0,491,489,1,0,0,0,492,495,1,0,0,0,493,491,
        1,0,0,0,493,494,1,0,0,0,494,505,1,0,0,0,495,493,1,0,0,0,496,502,
        5,59,0,0,497,503,3,84,42,0,498,503,3,86,43,0,499,503,3,88,44,0,500,
        503,3,90,45,0,501,503,3,76,38,0,502,497,1,0,0,0,502,498,1,0,0,0,
        502,499,1,0,0,0,502,500,1,0,0,0,502,501,1,0,0,0,503,506,1,0,0,0,
        504,506,3,78,39,0,505,496,1,0,0,0,505,504,1,0,0,0,506,75,1,0,0,0,
        507,508,7,1,0,0,508,510,5,25,0,0,509,507,1,0,0,0,510,511,1,0,0,0,
        511,509,1,0,0,0,511,512,1,0,0,0,512,513,1,0,0,0,513,516,3,26,13,
        0,514,516,3,94,47,0,515,509,1,0,0,0,515,514,1,0,0,0,516,519,1,0,
        0,0,517,518,5,63,0,0,518,520,3,94,47,0,519,517,1,0,0,0,519,520,1,
        0,0,0,520,521,1,0,0,0,521,522,3,78,39,0,522,77,1,0,0,0,523,532,3,
        8,4,0,524,526,5,1,0,0,525,527,3,2,1,0,526,525,1,0,0,0,526,527,1,
        0,0,0,527,529,1,0,0,0,528,530,3,8,4,0,529,528,1,0,0,0,529,530,1,
        0,0,0,530,532,1,0,0,0,531,523,1,0,0,0,531,524,1,0,0,0,532,79,1,0,
        0,0,533,534,5,44,0,0,534,535,3,60,30,0,535,536,3,6,3,0,536,81,1,
        0,0,0,537,551,5,43,0,0,538,539,5,59,0,0,539,541,5,1,0,0,540,542,
        3,2,1,0,541,540,1,0,0,0,541,542,1,0,0,0,542,544,1,0,0,0,543,545,
        3,8,4,0,544,543,1,0,0,0,544,545,1,0,0,0,545,552,1,0,0,0,546,552,
        3,84,42,0,547,552,3,86,43,0,548,552,3,88,44,0,549,552,3,90,45,0,
        550,552,3,74,37,0,551,538,1,0,0,0,551,546,1,0,0,0,551,547,1,0,0,
        0,551,548,1,0,0,0,551,549,1,0,0,0,551,550,1,0,0,0,552,83,1,0,0,0,
        553,559,7,4,0,0,554,556,5,69,0,0,555,557,3,98,49,0,556,555,1,0,0,
        0,556,557,1,0,0,0,557,558,1,0,0,0,558,560,5,70,0,0,559,554,1,0,0,
        0,559,560,1,0,0,0,560,562,1,0,0,0,561,563,5,59,0,0,562,561,1,0,0,
        0,562,563,1,0,0,0,563,564,1,0,0,0,564,566,5,1,0,0,565,567,3,2,1,
        0,566,565,1,0,0,0,566,567,1,0,0,0,567,569,1,0,0,0,568,570,3,8,4,
        0,569,568,1,0,0,0,569,570,1,0,0,0,570,85,1,0,0,0,571,572,5,48,0,
        0,572,573,3,60,30,0,573,575,5,1,0,0,574,576,3,2,1,0,575,574,1,0,
        0,0,575,576,1,0,0,0,576,87,1,0,0,0,577,578,5,49,0,0,578,579,3,94,
        47,0,579,581,5,1,0,0,580,582,3,2,1,0,581,580,1,0,0,0,581,582,1,0,
        0,0,582,89,1,0,0,0,583,584,5,50,0,0,584,585,3,94,47,0,585,587,5,
        1,0,0,586,588,3,2,1,0,587,586,1,0,0,0,587,588,1,0,0,0,588,91,1,0,
        0,0,589,590,5,51,0,0,590,591,3,60,30,0,591,593,5,1,0,0,592,594,3,
        2,1,0,593,592,1,0,0,0,593,594,1,0,0,0,594,93,1,0,0,0,595,597,7,5,
        0,0,596,595,1,0,0,0,597,600,1,0,0,0,598,596,1,0,0,0,598,599,1,0,
        0,0,599,607,1,0,0,0,600,598,1,0,0,0,601,608,5,4,0,0,602,608,5,5,
        0,0,603,608,5,6,0,0,604,608,5,7,0,0,605,608,5,8,0,0,606,608,3,96,
        48,0,607,601,1,0,0,0,607,602,1,0,0,0,607,603,1,0,0,0,607,604,1,0,
        0,0,607,605,1,0,0,0,607,606,1,0,0,0,608,646,1,0,0,0,609,616,5,61,
        0,0,610,617,5,4,0,0,611,612,7,6,0,0,612,613,5,69,0,0,613,614,3,24,
        12,0,614,615,5,70,0,0,615,617,1,0,0,0,616,610,1,0,0,0,616,611,1,
        0,0,0,617,645,1,0,0,0,618,619,5,67,0,0,619,645,5,4,0,0,620,621,5,
        71,0,0,621,622,3,94,47,0,622,623,5,72,0,0,623,645,1,0,0,0,624,626,
        5,69,0,0,625,627,3,98,49,0,626,625,1,0,0,0,626,627,1,0,0,0,627,628,
        1,0,0,0,628,645,5,70,0,0,629,633,7,7,0,0,630,632,7,5,0,0,631,630,
        1,0,0,0,632,635,1,0,0,0,633,631,1,0,0,0,633,634,1,0,0,0,634,642,
        1,0,0,0,635,633,1,0,0,0,636,643,5,4,0,0,637,643,5,5,0,0,638,643,
        5,6,0,0,639,643,5,7,0,0,640,643,5,8,0,0,641,643,3,96,48,0,642,636,
        1,0,0,0,642,637,1,0,0,0,642,638,1,0,0,0,642,639,1,0,0,0,642,640,
        1,0,0,0,642,641,1,0,0,0,643,645,1,0,0,0,644,609,1,0,0,0,644,618,
        1,0,0,0,644,620,1,0,0,0,644,624,1,0,0,0,644,629,1,0,0,0,645,648,
        1,0,0,0,646,644,1,0,0,0,646,647,1,0,0,0,647,654,1,0,0,0,648,646,
        1,0,0,0,649,650,5,66,0,0,650,651,3,94,47,0,651,652,5,59,0,0,652,
        653,3,94,47,0,653,655,1,0,0,0,654,649,1,0,0,0,654,655,1,0,0,0,655,
        95,1,0,0,0,656,657,5,69,0,0,657,658,3,94,47,0,658,659,5,70,0,0,659,
        677,1,0,0,0,660,673,5,71,0,0,661,671,3,94,47,0,662,663,5,62,0,0,
        663,672,3,94,47,0,664,665,5,60,0,0,665,667,3,94,47,0,666,664,1,0,
        0,0,667,670,1,0,0,0,668,666,1,0,0,0,668,669,1,0,0,0,669,672,1,0,
        0,0,670,668,1,0,0,0,671,662,1,0,0,0,671,668,1,0,0,0,672,674,1,0,
        0,0,673,661,1,0,0,0,673,674,1,0,0,0,674,675,1,0,0,0,675,677,5,72,
        0,0,676,656,1,0,0,0,676,660,1,0,0,0,677,97,1,0,0,0,678,681,3,94,
        47,0,679,680,5,59,0,0,680,682,3,94,47,0,681,679,1,0,0,0,681,682,
        1,0,0,0,682,691,1,0,0,0,683,684,5,60,0,0,684,687,3,94,47,0,685,686,
        5,59,0,0,686,688,3,94,47,0,687,685,1,0,0,0,687,688,1,0,0,0,688,690,
        1,0,0,0,689,683,1,0,0,0,690,693,1,0,0,0,691,689,1,0,0,0,691,692,
        1,0,0,0,692,99,1,0,0,0,693,691,1,0,0,0,97,101,106,115,148,151,155,
        159,163,166,171,175,182,193,196,200,208,213,221,226,237,245,253,
        263,268,278,286,294,299,306,313,320,328,338,343,346,350,356,359,
        363,367,374,382,385,390,394,402,410,412,423,431,436,440,449,453,
        457,462,468,476,481,486,493,502,505,511,515,519,526,529,531,541,
        544,551,556,559,562,566,569,575,581,587,593,598,607,616,626,633,
        642,644,646,654,668,671,673,676,681,687,691
    ]
atn = Network(serializedATN())
literalNames = [ "<INVALID>", "<INVALID>", "<INVALID>", "<INVALID>",
                 "<INVALID>", "<INVALID>", "<INVALID>", "<INVALID>",
                 "<INVALID>", "<INVALID>", "'import'", "'namespace'",
                 "'use'", "'export'", "'type'", "'unit'", "'enum'",
                 "'struct'", "'actor'", "'scenario'", "'action'", "'modifier'",
                 "'extend'", "'global'", "'inherits'", "'of'", "'is'",
                 "'event'", "'var'", "'def'", "'keep'", "'remove_default'",
                 "'cover'", "'record'", "'default'", "'hard'", "'only'",
                 "'expression'", "'undefined'", "'external'", "'sample'",
                 "'list'", "'range'", "'do'", "'on'", "'serial'", "'parallel'",
                 "'one_of'", "'wait'", "'emit'", "'call'", "'until'",
                 "'with'", "'as'", "'if'", "'and'", "'or'", "'not'",
                 "'in'", "':'", "','", "'.'", "'..'", "'='", "'@'",
                 "'->'", "'?'", "'!'", "'::'", "'('", "')'", "'['",
                 "']'", "'=>'", "'=='", "'!='", "'<'", "'<='", "'>'",
                 "'>='", "'+'", "'-'", "'*'", "'/'", "'%'" ]
RULE_sourceFile: Final = 0
RULE_block: Final = 1
RULE_statement: Final = 2
RULE_body: Final = 3
RULE_withBlock: Final = 4
RULE_importStatement: Final = 5
RULE_dottedName: Final = 6
RULE_namespaceStatement: Final = 7
RULE_useStatement: Final = 8
RULE_exportStatement: Final = 9
RULE_exportItem: Final = 10
RULE_globalParameter: Final = 11
RULE_typeName: Final = 12
RULE_behaviorName: Final = 13
RULE_physicalTypeDeclaration: Final = 14
RULE_unitDeclaration: Final = 15
RULE_siUnit: Final = 16
RULE_enumDeclaration: Final = 17
RULE_enumMembers: Final = 18
RULE_enumMember: Final = 19
RULE_structDeclaration: Final = 20
RULE_actorDeclaration: Final = 21
RULE_scenarioDeclaration: Final = 22
RULE_actionDeclaration: Final = 23
RULE_modifierDeclaration: Final = 24
RULE_inheritance: Final = 25
RULE_extension: Final = 26
RULE_eventDeclaration: Final = 27
RULE_parameters: Final = 28
RULE_parameter: Final = 29
RULE_eventSpecification: Final = 30
RULE_variableDeclaration: Final = 31
RULE_sampleExpression: Final = 32
RULE_methodDeclaration: Final = 33
RULE_keepConstraint: Final = 34
RULE_removeDefault: Final = 35
RULE_coverageDeclaration: Final = 36
RULE_nameStatement: Final = 37
RULE_typedRest: Final = 38
RULE_ending: Final = 39
RULE_onDirective: Final = 40
RULE_doDirective: Final = 41
RULE_composition: Final = 42
RULE_waitDirective: Final = 43
RULE_emitDirective: Final = 44
RULE_callDirective: Final = 45
RULE_untilDirective: Final = 46
RULE_expression: Final = 47
RULE_group: Final = 48
RULE_arguments: Final = 49
EOF: Final = -1
NEWLINE: Final = 1
INDENT: Final = 2
DEDENT: Final = 3
ID: Final = 4
INTEGER: Final = 5
FLOAT: Final = 6
PHYSICAL: Final = 7
STRING: Final = 8
NAMESPACE_STAR: Final = 9
IMPORT: Final = 10
NAMESPACE: Final = 11
USE: Final = 12
EXPORT: Final = 13
TYPE: Final = 14
UNIT: Final = 15
ENUM: Final = 16
STRUCT: Final = 17
ACTOR: Final = 18
SCENARIO: Final = 19
ACTION: Final = 20
MODIFIER: Final = 21
EXTEND: Final = 22
GLOBAL: Final = 23
INHERITS: Final = 24
OF: Final = 25
IS: Final = 26
EVENT: Final = 27
VAR: Final = 28
DEF: Final = 29
KEEP: Final = 30
REMOVE_DEFAULT: Final = 31
COVER: Final = 32
RECORD: Final = 33
DEFAULT: Final = 34
HARD: Final = 35
ONLY: Final = 36
EXPRESSION: Final = 37
UNDEFINED: Final = 38
EXTERNAL: Final = 39
SAMPLE: Final = 40
LIST: Final = 41
RANGE: Final = 42
DO: Final = 43
ON: Final = 44
SERIAL: Final = 45
PARALLEL: Final = 46
ONE_OF: Final = 47
WAIT: Final = 48
EMIT: Final = 49
CALL: Final = 50
UNTIL: Final = 51
WITH: Final = 52
AS: Final = 53
IF: Final = 54
AND: Final = 55
OR: Final = 56
NOT: Final = 57
IN: Final = 58
COLON: Final = 59
COMMA: Final = 60
DOT: Final = 61
RANGE_DOTS: Final = 62
ASSIGN: Final = 63
AT: Final = 64
ARROW: Final = 65
QUESTION: Final = 66
BANG: Final = 67
DOUBLE_COLON: Final = 68
LPAREN: Final = 69
RPAREN: Final = 70
LBRACKET: Final = 71
RBRACKET: Final = 72
IMPLIES: Final = 73
EQUAL: Final = 74
NOT_EQUAL: Final = 75
LESS: Final = 76
LESS_EQUAL: Final = 77
GREATER: Final = 78
GREATER_EQUAL: Final = 79
PLUS: Final = 80
MINUS: Final = 81
STAR: Final = 82
SLASH: Final = 83
PERCENT: Final = 84


class SourceFileContext(ParserRuleContext):
    __slots__ = ()


class BlockContext(ParserRuleContext):
    __slots__ = ()


class StatementContext(ParserRuleContext):
    __slots__ = ()


class BodyContext(ParserRuleContext):
    __slots__ = ()


class WithBlockContext(ParserRuleContext):
    __slots__ = ()


class ImportStatementContext(ParserRuleContext):
    __slots__ = ()


class DottedNameContext(ParserRuleContext):
    __slots__ = ()


class NamespaceStatementContext(ParserRuleContext):
    __slots__ = ()


class UseStatementContext(ParserRuleContext):
    __slots__ = ()


class ExportStatementContext(ParserRuleContext):
    __slots__ = ()


class ExportItemContext(ParserRuleContext):
    __slots__ = ()


class GlobalParameterContext(ParserRuleContext):
    __slots__ = ()


class TypeNameContext(ParserRuleContext):
    __slots__ = ()


class BehaviorNameContext(ParserRuleContext):
    __slots__ = ()


class PhysicalTypeDeclarationContext(ParserRuleContext):
    __slots__ = ()


class UnitDeclarationContext(ParserRuleContext):
    __slots__ = ()


class SiUnitContext(ParserRuleContext):
    __slots__ = ()


class EnumDeclarationContext(ParserRuleContext):
    __slots__ = ()


class EnumMembersContext(ParserRuleContext):
    __slots__ = ()


class EnumMemberContext(ParserRuleContext):
    __slots__ = ()


class StructDeclarationContext(ParserRuleContext):
    __slots__ = ()


class ActorDeclarationContext(ParserRuleContext):
    __slots__ = ()


class ScenarioDeclarationContext(ParserRuleContext):
    __slots__ = ()


class ActionDeclarationContext(ParserRuleContext):
    __slots__ = ()


class ModifierDeclarationContext(ParserRuleContext):
    __slots__ = ()


class InheritanceContext(ParserRuleContext):
    __slots__ = ()


class ExtensionContext(ParserRuleContext):
    __slots__ = ()


class EventDeclarationContext(ParserRuleContext):
    __slots__ = ()


class ParametersContext(ParserRuleContext):
    __slots__ = ()


class ParameterContext(ParserRuleContext):
    __slots__ = ()


class EventSpecificationContext(ParserRuleContext):
    __slots__ = ()


class VariableDeclarationContext(ParserRuleContext):
    __slots__ = ()


class SampleExpressionContext(ParserRuleContext):
    __slots__ = ()


class MethodDeclarationContext(ParserRuleContext):
    __slots__ = ()


class KeepConstraintContext(ParserRuleContext):
    __slots__ = ()


class RemoveDefaultContext(ParserRuleContext):
    __slots__ = ()


class CoverageDeclarationContext(ParserRuleContext):
    __slots__ = ()


class NameStatementContext(ParserRuleContext):
    __slots__ = ()


class TypedRestContext(ParserRuleContext):
    __slots__ = ()


class EndingContext(ParserRuleContext):
    __slots__ = ()


class OnDirectiveContext(ParserRuleContext):
    __slots__ = ()


class DoDirectiveContext(ParserRuleContext):
    __slots__ = ()


class CompositionContext(ParserRuleContext):
    __slots__ = ()


class WaitDirectiveContext(ParserRuleContext):
    __slots__ = ()


class EmitDirectiveContext(ParserRuleContext):
    __slots__ = ()


class CallDirectiveContext(ParserRuleContext):
    __slots__ = ()


class UntilDirectiveContext(ParserRuleContext):
    __slots__ = ()


class ExpressionContext(ParserRuleContext):
    __slots__ = ()


class GroupContext(ParserRuleContext):
    __slots__ = ()


class ArgumentsContext(ParserRuleContext):
    __slots__ = ()


class OpenSCENARIO2(Parser):
    def sourceFile(self) -> SourceFileContext:
        stream = self._input
        localctx = SourceFileContext(self._ctx, self.state)
        self.enterRule(localctx, 0, RULE_sourceFile)
        try:
            self.state = 101
            self._errHandler.sync(self)
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 100
                self.block()
            self.state = 106
            self._errHandler.sync(self)
            _la = stream.types[stream.index]
            while (((_la) & ~0x3f) == 0 and ((1 << _la) & 148610008672632304) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                self.state = 103
                self.statement()
                self.state = 108
                self._errHandler.sync(self)
                _la = stream.types[stream.index]
            self.state = 109
            self.match(EOF)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def block(self) -> BlockContext:
        stream = self._input
        localctx = BlockContext(self._ctx, self.state)
        self.enterRule(localctx, 2, RULE_block)
        try:
            self.state = 111
            self.match(INDENT)
            self.state = 115
            self._errHandler.sync(self)
            _la = stream.types[stream.index]
            while (((_la) & ~0x3f) == 0 and ((1 << _la) & 148610008672632304) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                self.state = 112
                self.statement()
                self.state = 117
                self._errHandler.sync(self)
                _la = stream.types[stream.index]
            self.state = 118
            self.match(DEDENT)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def statement(self) -> StatementContext:
        stream = self._input
        localctx = StatementContext(self._ctx, self.state)
        self.enterRule(localctx, 4, RULE_statement)
        try:
            self.state = 148
            token = stream.types[stream.index]
            if token in [4, 5, 6, 7, 8, 57, 69, 71, 80, 81]:
                self.state = 120
                self.nameStatement()
            elif token in [45, 46, 47]:
                self.state = 121
                self.composition()
            elif token in [48]:
                self.state = 122
                self.waitDirective()
            elif token in [30]:
                self.state = 123
                self.keepConstraint()
            elif token in [28]:
                self.state = 124
                self.variableDeclaration()
            elif token in [27]:
                self.state = 125
                self.eventDeclaration()
            elif token in [29]:
                self.state = 126
                self.methodDeclaration()
            elif token in [49]:
                self.state = 127
                self.emitDirective()
            elif token in [50]:
                self.state = 128
                self.callDirective()
            elif token in [51]:
                self.state = 129
                self.untilDirective()
            elif token in [44]:
                self.state = 130
                self.onDirective()
            elif token in [43]:
                self.state = 131
                self.doDirective()
            elif token in [17]:
                self.state = 132
                self.structDeclaration()
            elif token in [18]:
                self.state = 133
                self.actorDeclaration()
            elif token in [19]:
                self.state = 134
                self.scenarioDeclaration()
            elif token in [20]:
                self.state = 135
                self.actionDeclaration()
            elif token in [21]:
                self.state = 136
                self.modifierDeclaration()
            elif token in [16]:
                self.state = 137
                self.enumDeclaration()
            elif token in [15]:
                self.state = 138
                self.unitDeclaration()
            elif token in [14]:
                self.state = 139
                self.physicalTypeDeclaration()
            elif token in [22]:
                self.state = 140
                self.extension()
            elif token in [23]:
                self.state = 141
                self.globalParameter()
            elif token in [31]:
                self.state = 142
                self.removeDefault()
            elif token in [32, 33]:
                self.state = 143
                self.coverageDeclaration()
            elif token in [10]:
                self.state = 144
                self.importStatement()
            elif token in [11]:
                self.state = 145
                self.namespaceStatement()
            elif token in [12]:
                self.state = 146
                self.useStatement()
            elif token in [13]:
                self.state = 147
                self.exportStatement()
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def body(self) -> BodyContext:
        stream = self._input
        localctx = BodyContext(self._ctx, self.state)
        self.enterRule(localctx, 6, RULE_body)
        try:
            self.state = 151
            _la = stream.types[stream.index]
            if _la==59:
                self.state = 150
                self.match(COLON)
            self.state = 153
            self.match(NEWLINE)
            self.state = 155
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 154
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def withBlock(self) -> WithBlockContext:
        stream = self._input
        localctx = WithBlockContext(self._ctx, self.state)
        self.enterRule(localctx, 8, RULE_withBlock)
        try:
            self.state = 157
            self.match(WITH)
            self.state = 159
            _la = stream.types[stream.index]
            if _la==59:
                self.state = 158
                self.match(COLON)
            self.state = 166
            token = stream.types[stream.index]
            if token in [1]:
                self.state = 161
                self.match(NEWLINE)
                self.state = 163
                _la = stream.types[stream.index]
                if _la==2:
                    self.state = 162
                    self.block()
            elif token in [4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 27, 28, 29, 30, 31, 32, 33, 43, 44, 45, 46, 47, 48, 49, 50, 51, 57, 69, 71, 80, 81]:
                self.state = 165
                self.statement()
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def importStatement(self) -> ImportStatementContext:
        stream = self._input
        localctx = ImportStatementContext(self._ctx, self.state)
        self.enterRule(localctx, 10, RULE_importStatement)
        try:
            self.state = 168
            self.match(IMPORT)
            self.state = 171
            token = stream.types[stream.index]
            if token in [8]:
                self.state = 169
                self.match(STRING)
            elif token in [4]:
                self.state = 170
                self.dottedName()
            else:
                raise NoViableAltException(self)
            self.state = 173
            self.match(NEWLINE)
            self.state = 175
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 174
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def dottedName(self) -> DottedNameContext:
        stream = self._input
        localctx = DottedNameContext(self._ctx, self.state)
        self.enterRule(localctx, 12, RULE_dottedName)
        try:
            self.state = 177
            self.match(ID)
            self.state = 182
            _la = stream.types[stream.index]
            while _la==61:
                self.state = 178
                self.match(DOT)
                self.state = 179
                self.match(ID)
                self.state = 184
                _la = stream.types[stream.index]
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def namespaceStatement(self) -> NamespaceStatementContext:
        stream = self._input
        localctx = NamespaceStatementContext(self._ctx, self.state)
        self.enterRule(localctx, 14, RULE_namespaceStatement)
        try:
            self.state = 185
            self.match(NAMESPACE)
            self.state = 186
            self.match(ID)
            self.state = 196
            _la = stream.types[stream.index]
            if _la==12:
                self.state = 187
                self.match(USE)
                self.state = 188
                self.dottedName()
                self.state = 193
                _la = stream.types[stream.index]
                while _la==60:
                    self.state = 189
                    self.match(COMMA)
                    self.state = 190
                    self.dottedName()
                    self.state = 195
                    _la = stream.types[stream.index]
            self.state = 198
            self.match(NEWLINE)
            self.state = 200
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 199
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def useStatement(self) -> UseStatementContext:
        stream = self._input
        localctx = UseStatementContext(self._ctx, self.state)
        self.enterRule(localctx, 16, RULE_useStatement)
        try:
            self.state = 202
            self.match(USE)
            self.state = 203
            self.dottedName()
            self.state = 208
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 204
                self.match(COMMA)
                self.state = 205
                self.dottedName()
                self.state = 210
                _la = stream.types[stream.index]
            self.state = 211
            self.match(NEWLINE)
            self.state = 213
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 212
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def exportStatement(self) -> ExportStatementContext:
        stream = self._input
        localctx = ExportStatementContext(self._ctx, self.state)
        self.enterRule(localctx, 18, RULE_exportStatement)
        try:
            self.state = 215
            self.match(EXPORT)
            self.state = 216
            self.exportItem()
            self.state = 221
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 217
                self.match(COMMA)
                self.state = 218
                self.exportItem()
                self.state = 223
                _la = stream.types[stream.index]
            self.state = 224
            self.match(NEWLINE)
            self.state = 226
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 225
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def exportItem(self) -> ExportItemContext:
        stream = self._input
        localctx = ExportItemContext(self._ctx, self.state)
        self.enterRule(localctx, 20, RULE_exportItem)
        try:
            self.state = 228
            _la = stream.types[stream.index]
            if not(_la==4 or _la==9 or _la==82):
                self._errHandler.recoverInline(self)
            else:
                self.consume()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def globalParameter(self) -> GlobalParameterContext:
        localctx = GlobalParameterContext(self._ctx, self.state)
        self.enterRule(localctx, 22, RULE_globalParameter)
        try:
            self.state = 230
            self.match(GLOBAL)
            self.state = 231
            self.nameStatement()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def typeName(self) -> TypeNameContext:
        stream = self._input
        localctx = TypeNameContext(self._ctx, self.state)
        self.enterRule(localctx, 24, RULE_typeName)
        try:
            self.state = 237
            _la = stream.types[stream.index]
            while _la==41 or _la==42:
                self.state = 233
                _la = stream.types[stream.index]
                if not(_la==41 or _la==42):
                    self._errHandler.recoverInline(self)
                else:
                    self.consume()
                self.state = 234
                self.match(OF)
                self.state = 239
                _la = stream.types[stream.index]
            self.state = 240
            self.behaviorName()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def behaviorName(self) -> BehaviorNameContext:
        stream = self._input
        localctx = BehaviorNameContext(self._ctx, self.state)
        self.enterRule(localctx, 26, RULE_behaviorName)
        try:
            self.state = 242
            self.match(ID)
            self.state = 245
            _la = stream.types[stream.index]
            if _la==61:
                self.state = 243
                self.match(DOT)
                self.state = 244
                self.match(ID)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def physicalTypeDeclaration(self) -> PhysicalTypeDeclarationContext:
        stream = self._input
        localctx = PhysicalTypeDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 28, RULE_physicalTypeDeclaration)
        try:
            self.state = 247
            self.match(TYPE)
            self.state = 248
            self.match(ID)
            self.state = 249
            self.match(IS)
            self.state = 250
            self.siUnit()
            self.state = 251
            self.match(NEWLINE)
            self.state = 253
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 252
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def unitDeclaration(self) -> UnitDeclarationContext:
        stream = self._input
        localctx = UnitDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 30, RULE_unitDeclaration)
        try:
            self.state = 255
            self.match(UNIT)
            self.state = 256
            self.match(ID)
            self.state = 257
            self.match(OF)
            self.state = 258
            self.match(ID)
            self.state = 259
            self.match(IS)
            self.state = 260
            self.siUnit()
            self.state = 261
            self.match(NEWLINE)
            self.state = 263
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 262
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def siUnit(self) -> SiUnitContext:
        stream = self._input
        localctx = SiUnitContext(self._ctx, self.state)
        self.enterRule(localctx, 32, RULE_siUnit)
        try:
            self.state = 265
            self.match(ID)
            self.state = 266
            self.match(LPAREN)
            self.state = 268
            _la = stream.types[stream.index]
            if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                self.state = 267
                self.arguments()
            self.state = 270
            self.match(RPAREN)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def enumDeclaration(self) -> EnumDeclarationContext:
        stream = self._input
        localctx = EnumDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 34, RULE_enumDeclaration)
        try:
            self.state = 272
            self.match(ENUM)
            self.state = 273
            self.match(ID)
            self.state = 274
            self.match(COLON)
            self.state = 275
            self.enumMembers()
            self.state = 276
            self.match(NEWLINE)
            self.state = 278
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 277
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def enumMembers(self) -> EnumMembersContext:
        stream = self._input
        localctx = EnumMembersContext(self._ctx, self.state)
        self.enterRule(localctx, 36, RULE_enumMembers)
        try:
            self.state = 280
            self.match(LBRACKET)
            self.state = 281
            self.enumMember()
            self.state = 286
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 282
                self.match(COMMA)
                self.state = 283
                self.enumMember()
                self.state = 288
                _la = stream.types[stream.index]
            self.state = 289
            self.match(RBRACKET)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def enumMember(self) -> EnumMemberContext:
        stream = self._input
        localctx = EnumMemberContext(self._ctx, self.state)
        self.enterRule(localctx, 38, RULE_enumMember)
        try:
            self.state = 291
            self.match(ID)
            self.state = 294
            _la = stream.types[stream.index]
            if _la==63:
                self.state = 292
                self.match(ASSIGN)
                self.state = 293
                self.expression()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def structDeclaration(self) -> StructDeclarationContext:
        stream = self._input
        localctx = StructDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 40, RULE_structDeclaration)
        try:
            self.state = 296
            self.match(STRUCT)
            self.state = 297
            self.behaviorName()
            self.state = 299
            _la = stream.types[stream.index]
            if _la==24:
                self.state = 298
                self.inheritance()
            self.state = 301
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def actorDeclaration(self) -> ActorDeclarationContext:
        stream = self._input
        localctx = ActorDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 42, RULE_actorDeclaration)
        try:
            self.state = 303
            self.match(ACTOR)
            self.state = 304
            self.behaviorName()
            self.state = 306
            _la = stream.types[stream.index]
            if _la==24:
                self.state = 305
                self.inheritance()
            self.state = 308
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def scenarioDeclaration(self) -> ScenarioDeclarationContext:
        stream = self._input
        localctx = ScenarioDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 44, RULE_scenarioDeclaration)
        try:
            self.state = 310
            self.match(SCENARIO)
            self.state = 311
            self.behaviorName()
            self.state = 313
            _la = stream.types[stream.index]
            if _la==24:
                self.state = 312
                self.inheritance()
            self.state = 315
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def actionDeclaration(self) -> ActionDeclarationContext:
        stream = self._input
        localctx = ActionDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 46, RULE_actionDeclaration)
        try:
            self.state = 317
            self.match(ACTION)
            self.state = 318
            self.behaviorName()
            self.state = 320
            _la = stream.types[stream.index]
            if _la==24:
                self.state = 319
                self.inheritance()
            self.state = 322
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def modifierDeclaration(self) -> ModifierDeclarationContext:
        stream = self._input
        localctx = ModifierDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 48, RULE_modifierDeclaration)
        try:
            self.state = 324
            self.match(MODIFIER)
            self.state = 325
            self.behaviorName()
            self.state = 328
            _la = stream.types[stream.index]
            if _la==25:
                self.state = 326
                self.match(OF)
                self.state = 327
                self.behaviorName()
            self.state = 330
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def inheritance(self) -> InheritanceContext:
        stream = self._input
        localctx = InheritanceContext(self._ctx, self.state)
        self.enterRule(localctx, 50, RULE_inheritance)
        try:
            self.state = 332
            self.match(INHERITS)
            self.state = 333
            self.behaviorName()
            self.state = 338
            _la = stream.types[stream.index]
            if _la==69:
                self.state = 334
                self.match(LPAREN)
                self.state = 335
                self.expression()
                self.state = 336
                self.match(RPAREN)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def extension(self) -> ExtensionContext:
        stream = self._input
        localctx = ExtensionContext(self._ctx, self.state)
        self.enterRule(localctx, 52, RULE_extension)
        try:
            self.state = 340
            self.match(EXTEND)
            self.state = 341
            self.behaviorName()
            self.state = 343
            _la = stream.types[stream.index]
            if _la==59:
                self.state = 342
                self.match(COLON)
            self.state = 346
            _la = stream.types[stream.index]
            if _la==71:
                self.state = 345
                self.enumMembers()
            self.state = 348
            self.match(NEWLINE)
            self.state = 350
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 349
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def eventDeclaration(self) -> EventDeclarationContext:
        stream = self._input
        localctx = EventDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 54, RULE_eventDeclaration)
        try:
            self.state = 352
            self.match(EVENT)
            self.state = 353
            self.match(ID)
            self.state = 359
            _la = stream.types[stream.index]
            if _la==69:
                self.state = 354
                self.match(LPAREN)
                self.state = 356
                _la = stream.types[stream.index]
                if _la==4:
                    self.state = 355
                    self.parameters()
                self.state = 358
                self.match(RPAREN)
            self.state = 363
            _la = stream.types[stream.index]
            if _la==26:
                self.state = 361
                self.match(IS)
                self.state = 362
                self.eventSpecification()
            self.state = 365
            self.match(NEWLINE)
            self.state = 367
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 366
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def parameters(self) -> ParametersContext:
        stream = self._input
        localctx = ParametersContext(self._ctx, self.state)
        self.enterRule(localctx, 56, RULE_parameters)
        try:
            self.state = 369
            self.parameter()
            self.state = 374
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 370
                self.match(COMMA)
                self.state = 371
                self.parameter()
                self.state = 376
                _la = stream.types[stream.index]
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def parameter(self) -> ParameterContext:
        stream = self._input
        localctx = ParameterContext(self._ctx, self.state)
        self.enterRule(localctx, 58, RULE_parameter)
        try:
            self.state = 377
            self.match(ID)
            self.state = 378
            self.match(COLON)
            self.state = 379
            self.typeName()
            self.state = 382
            _la = stream.types[stream.index]
            if _la==63:
                self.state = 380
                self.match(ASSIGN)
                self.state = 381
                self.expression()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def eventSpecification(self) -> EventSpecificationContext:
        stream = self._input
        localctx = EventSpecificationContext(self._ctx, self.state)
        self.enterRule(localctx, 60, RULE_eventSpecification)
        try:
            self.state = 385
            _la = stream.types[stream.index]
            if _la==64:
                self.state = 384
                self.match(AT)
            self.state = 387
            self.expression()
            self.state = 390
            _la = stream.types[stream.index]
            if _la==53:
                self.state = 388
                self.match(AS)
                self.state = 389
                self.match(ID)
            self.state = 394
            _la = stream.types[stream.index]
            if _la==54:
                self.state = 392
                self.match(IF)
                self.state = 393
                self.expression()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def variableDeclaration(self) -> VariableDeclarationContext:
        stream = self._input
        localctx = VariableDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 62, RULE_variableDeclaration)
        try:
            self.state = 396
            self.match(VAR)
            self.state = 397
            self.match(ID)
            self.state = 402
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 398
                self.match(COMMA)
                self.state = 399
                self.match(ID)
                self.state = 404
                _la = stream.types[stream.index]
            self.state = 405
            self.match(COLON)
            self.state = 406
            self.typeName()
            self.state = 412
            _la = stream.types[stream.index]
            if _la==63:
                self.state = 407
                self.match(ASSIGN)
                self.state = 410
                token = stream.types[stream.index]
                if token in [40]:
                    self.state = 408
                    self.sampleExpression()
                elif token in [4, 5, 6, 7, 8, 57, 69, 71, 80, 81]:
                    self.state = 409
                    self.expression()
                else:
                    raise NoViableAltException(self)
            self.state = 414
            self.ending()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def sampleExpression(self) -> SampleExpressionContext:
        stream = self._input
        localctx = SampleExpressionContext(self._ctx, self.state)
        self.enterRule(localctx, 64, RULE_sampleExpression)
        try:
            self.state = 416
            self.match(SAMPLE)
            self.state = 417
            self.match(LPAREN)
            self.state = 418
            self.expression()
            self.state = 419
            self.match(COMMA)
            self.state = 420
            self.eventSpecification()
            self.state = 423
            _la = stream.types[stream.index]
            if _la==60:
                self.state = 421
                self.match(COMMA)
                self.state = 422
                self.expression()
            self.state = 425
            self.match(RPAREN)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def methodDeclaration(self) -> MethodDeclarationContext:
        stream = self._input
        localctx = MethodDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 66, RULE_methodDeclaration)
        try:
            self.state = 427
            self.match(DEF)
            self.state = 428
            self.match(ID)
            self.state = 429
            self.match(LPAREN)
            self.state = 431
            _la = stream.types[stream.index]
            if _la==4:
                self.state = 430
                self.parameters()
            self.state = 433
            self.match(RPAREN)
            self.state = 436
            _la = stream.types[stream.index]
            if _la==65:
                self.state = 434
                self.match(ARROW)
                self.state = 435
                self.typeName()
            self.state = 438
            self.match(IS)
            self.state = 440
            _la = stream.types[stream.index]
            if _la==36:
                self.state = 439
                self.match(ONLY)
            self.state = 453
            token = stream.types[stream.index]
            if token in [37]:
                self.state = 442
                self.match(EXPRESSION)
                self.state = 443
                self.expression()
            elif token in [38]:
                self.state = 444
                self.match(UNDEFINED)
            elif token in [39]:
                self.state = 445
                self.match(EXTERNAL)
                self.state = 446
                self.dottedName()
                self.state = 447
                self.match(LPAREN)
                self.state = 449
                _la = stream.types[stream.index]
                if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                    self.state = 448
                    self.arguments()
                self.state = 451
                self.match(RPAREN)
            else:
                raise NoViableAltException(self)
            self.state = 455
            self.match(NEWLINE)
            self.state = 457
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 456
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def keepConstraint(self) -> KeepConstraintContext:
        stream = self._input
        localctx = KeepConstraintContext(self._ctx, self.state)
        self.enterRule(localctx, 68, RULE_keepConstraint)
        try:
            self.state = 459
            self.match(KEEP)
            self.state = 460
            self.match(LPAREN)
            self.state = 462
            _la = stream.types[stream.index]
            if _la==34 or _la==35:
                self.state = 461
                _la = stream.types[stream.index]
                if not(_la==34 or _la==35):
                    self._errHandler.recoverInline(self)
                else:
                    self.consume()
            self.state = 464
            self.expression()
            self.state = 465
            self.match(RPAREN)
            self.state = 466
            self.match(NEWLINE)
            self.state = 468
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 467
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def removeDefault(self) -> RemoveDefaultContext:
        stream = self._input
        localctx = RemoveDefaultContext(self._ctx, self.state)
        self.enterRule(localctx, 70, RULE_removeDefault)
        try:
            self.state = 470
            self.match(REMOVE_DEFAULT)
            self.state = 471
            self.match(LPAREN)
            self.state = 472
            self.expression()
            self.state = 473
            self.match(RPAREN)
            self.state = 474
            self.match(NEWLINE)
            self.state = 476
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 475
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def coverageDeclaration(self) -> CoverageDeclarationContext:
        stream = self._input
        localctx = CoverageDeclarationContext(self._ctx, self.state)
        self.enterRule(localctx, 72, RULE_coverageDeclaration)
        try:
            self.state = 478
            _la = stream.types[stream.index]
            if not(_la==32 or _la==33):
                self._errHandler.recoverInline(self)
            else:
                self.consume()
            self.state = 479
            self.match(LPAREN)
            self.state = 481
            _la = stream.types[stream.index]
            if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                self.state = 480
                self.arguments()
            self.state = 483
            self.match(RPAREN)
            self.state = 484
            self.match(NEWLINE)
            self.state = 486
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 485
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def nameStatement(self) -> NameStatementContext:
        stream = self._input
        localctx = NameStatementContext(self._ctx, self.state)
        self.enterRule(localctx, 74, RULE_nameStatement)
        try:
            self.state = 488
            self.expression()
            self.state = 493
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 489
                self.match(COMMA)
                self.state = 490
                self.expression()
                self.state = 495
                _la = stream.types[stream.index]
            self.state = 505
            token = stream.types[stream.index]
            if token in [59]:
                self.state = 496
                self.match(COLON)
                self.state = 502
                token = stream.types[stream.index]
                if token in [45, 46, 47]:
                    self.state = 497
                    self.composition()
                elif token in [48]:
                    self.state = 498
                    self.waitDirective()
                elif token in [49]:
                    self.state = 499
                    self.emitDirective()
                elif token in [50]:
                    self.state = 500
                    self.callDirective()
                elif token in [4, 5, 6, 7, 8, 41, 42, 57, 69, 71, 80, 81]:
                    self.state = 501
                    self.typedRest()
                else:
                    raise NoViableAltException(self)
            elif token in [1, 52]:
                self.state = 504
                self.ending()
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def typedRest(self) -> TypedRestContext:
        stream = self._input
        localctx = TypedRestContext(self._ctx, self.state)
        self.enterRule(localctx, 76, RULE_typedRest)
        try:
            self.state = 515
            token = stream.types[stream.index]
            if token in [41, 42]:
                self.state = 509
                _la = stream.types[stream.index]
                while True:
                    self.state = 507
                    _la = stream.types[stream.index]
                    if not(_la==41 or _la==42):
                        self._errHandler.recoverInline(self)
                    else:
                        self.consume()
                    self.state = 508
                    self.match(OF)
                    self.state = 511
                    _la = stream.types[stream.index]
                    if not (_la==41 or _la==42):
                        break
                self.state = 513
                self.behaviorName()
            elif token in [4, 5, 6, 7, 8, 57, 69, 71, 80, 81]:
                self.state = 514
                self.expression()
            else:
                raise NoViableAltException(self)
            self.state = 519
            _la = stream.types[stream.index]
            if _la==63:
                self.state = 517
                self.match(ASSIGN)
                self.state = 518
                self.expression()
            self.state = 521
            self.ending()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def ending(self) -> EndingContext:
        stream = self._input
        localctx = EndingContext(self._ctx, self.state)
        self.enterRule(localctx, 78, RULE_ending)
        try:
            self.state = 531
            token = stream.types[stream.index]
            if token in [52]:
                self.state = 523
                self.withBlock()
            elif token in [1]:
                self.state = 524
                self.match(NEWLINE)
                self.state = 526
                _la = stream.types[stream.index]
                if _la==2:
                    self.state = 525
                    self.block()
                self.state = 529
                _la = stream.types[stream.index]
                if _la==52:
                    self.state = 528
                    self.withBlock()
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def onDirective(self) -> OnDirectiveContext:
        localctx = OnDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 80, RULE_onDirective)
        try:
            self.state = 533
            self.match(ON)
            self.state = 534
            self.eventSpecification()
            self.state = 535
            self.body()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def doDirective(self) -> DoDirectiveContext:
        stream = self._input
        localctx = DoDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 82, RULE_doDirective)
        try:
            self.state = 537
            self.match(DO)
            self.state = 551
            token = stream.types[stream.index]
            if token in [59]:
                self.state = 538
                self.match(COLON)
                self.state = 539
                self.match(NEWLINE)
                self.state = 541
                _la = stream.types[stream.index]
                if _la==2:
                    self.state = 540
                    self.block()
                self.state = 544
                _la = stream.types[stream.index]
                if _la==52:
                    self.state = 543
                    self.withBlock()
            elif token in [45, 46, 47]:
                self.state = 546
                self.composition()
            elif token in [48]:
                self.state = 547
                self.waitDirective()
            elif token in [49]:
                self.state = 548
                self.emitDirective()
            elif token in [50]:
                self.state = 549
                self.callDirective()
            elif token in [4, 5, 6, 7, 8, 57, 69, 71, 80, 81]:
                self.state = 550
                self.nameStatement()
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def composition(self) -> CompositionContext:
        stream = self._input
        localctx = CompositionContext(self._ctx, self.state)
        self.enterRule(localctx, 84, RULE_composition)
        try:
            self.state = 553
            _la = stream.types[stream.index]
            if not((((_la) & ~0x3f) == 0 and ((1 << _la) & 246290604621824) != 0)):
                self._errHandler.recoverInline(self)
            else:
                self.consume()
            self.state = 559
            _la = stream.types[stream.index]
            if _la==69:
                self.state = 554
                self.match(LPAREN)
                self.state = 556
                _la = stream.types[stream.index]
                if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                    self.state = 555
                    self.arguments()
                self.state = 558
                self.match(RPAREN)
            self.state = 562
            _la = stream.types[stream.index]
            if _la==59:
                self.state = 561
                self.match(COLON)
            self.state = 564
            self.match(NEWLINE)
            self.state = 566
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 565
                self.block()
            self.state = 569
            _la = stream.types[stream.index]
            if _la==52:
                self.state = 568
                self.withBlock()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def waitDirective(self) -> WaitDirectiveContext:
        stream = self._input
        localctx = WaitDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 86, RULE_waitDirective)
        try:
            self.state = 571
            self.match(WAIT)
            self.state = 572
            self.eventSpecification()
            self.state = 573
            self.match(NEWLINE)
            self.state = 575
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 574
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def emitDirective(self) -> EmitDirectiveContext:
        stream = self._input
        localctx = EmitDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 88, RULE_emitDirective)
        try:
            self.state = 577
            self.match(EMIT)
            self.state = 578
            self.expression()
            self.state = 579
            self.match(NEWLINE)
            self.state = 581
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 580
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def callDirective(self) -> CallDirectiveContext:
        stream = self._input
        localctx = CallDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 90, RULE_callDirective)
        try:
            self.state = 583
            self.match(CALL)
            self.state = 584
            self.expression()
            self.state = 585
            self.match(NEWLINE)
            self.state = 587
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 586
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def untilDirective(self) -> UntilDirectiveContext:
        stream = self._input
        localctx = UntilDirectiveContext(self._ctx, self.state)
        self.enterRule(localctx, 92, RULE_untilDirective)
        try:
            self.state = 589
            self.match(UNTIL)
            self.state = 590
            self.eventSpecification()
            self.state = 591
            self.match(NEWLINE)
            self.state = 593
            _la = stream.types[stream.index]
            if _la==2:
                self.state = 592
                self.block()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def expression(self) -> ExpressionContext:
        stream = self._input
        localctx = ExpressionContext(self._ctx, self.state)
        self.enterRule(localctx, 94, RULE_expression)
        try:
            self.state = 598
            _la = stream.types[stream.index]
            while ((((_la - 57)) & ~0x3f) == 0 and ((1 << (_la - 57)) & 25165825) != 0):
                self.state = 595
                _la = stream.types[stream.index]
                if not(((((_la - 57)) & ~0x3f) == 0 and ((1 << (_la - 57)) & 25165825) != 0)):
                    self._errHandler.recoverInline(self)
                else:
                    self.consume()
                self.state = 600
                _la = stream.types[stream.index]
            self.state = 607
            token = stream.types[stream.index]
            if token in [4]:
                self.state = 601
                self.match(ID)
            elif token in [5]:
                self.state = 602
                self.match(INTEGER)
            elif token in [6]:
                self.state = 603
                self.match(FLOAT)
            elif token in [7]:
                self.state = 604
                self.match(PHYSICAL)
            elif token in [8]:
                self.state = 605
                self.match(STRING)
            elif token in [69, 71]:
                self.state = 606
                self.group()
            else:
                raise NoViableAltException(self)
            self.state = 646
            _la = stream.types[stream.index]
            while ((((_la - 55)) & ~0x3f) == 0 and ((1 << (_la - 55)) & 1073565771) != 0):
                self.state = 644
                token = stream.types[stream.index]
                if token in [61]:
                    self.state = 609
                    self.match(DOT)
                    self.state = 616
                    token = stream.types[stream.index]
                    if token in [4]:
                        self.state = 610
                        self.match(ID)
                    elif token in [26, 53]:
                        self.state = 611
                        _la = stream.types[stream.index]
                        if not(_la==26 or _la==53):
                            self._errHandler.recoverInline(self)
                        else:
                            self.consume()
                        self.state = 612
                        self.match(LPAREN)
                        self.state = 613
                        self.typeName()
                        self.state = 614
                        self.match(RPAREN)
                    else:
                        raise NoViableAltException(self)
                elif token in [67]:
                    self.state = 618
                    self.match(BANG)
                    self.state = 619
                    self.match(ID)
                elif token in [71]:
                    self.state = 620
                    self.match(LBRACKET)
                    self.state = 621
                    self.expression()
                    self.state = 622
                    self.match(RBRACKET)
                elif token in [69]:
                    self.state = 624
                    self.match(LPAREN)
                    self.state = 626
                    _la = stream.types[stream.index]
                    if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                        self.state = 625
                        self.arguments()
                    self.state = 628
                    self.match(RPAREN)
                elif token in [55, 56, 58, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84]:
                    self.state = 629
                    _la = stream.types[stream.index]
                    if not(((((_la - 55)) & ~0x3f) == 0 and ((1 << (_la - 55)) & 1073479691) != 0)):
                        self._errHandler.recoverInline(self)
                    else:
                        self.consume()
                    self.state = 633
                    _la = stream.types[stream.index]
                    while ((((_la - 57)) & ~0x3f) == 0 and ((1 << (_la - 57)) & 25165825) != 0):
                        self.state = 630
                        _la = stream.types[stream.index]
                        if not(((((_la - 57)) & ~0x3f) == 0 and ((1 << (_la - 57)) & 25165825) != 0)):
                            self._errHandler.recoverInline(self)
                        else:
                            self.consume()
                        self.state = 635
                        _la = stream.types[stream.index]
                    self.state = 642
                    token = stream.types[stream.index]
                    if token in [4]:
                        self.state = 636
                        self.match(ID)
                    elif token in [5]:
                        self.state = 637
                        self.match(INTEGER)
                    elif token in [6]:
                        self.state = 638
                        self.match(FLOAT)
                    elif token in [7]:
                        self.state = 639
                        self.match(PHYSICAL)
                    elif token in [8]:
                        self.state = 640
                        self.match(STRING)
                    elif token in [69, 71]:
                        self.state = 641
                        self.group()
                    else:
                        raise NoViableAltException(self)
                else:
                    raise NoViableAltException(self)
                self.state = 648
                _la = stream.types[stream.index]
            self.state = 654
            _la = stream.types[stream.index]
            if _la==66:
                self.state = 649
                self.match(QUESTION)
                self.state = 650
                self.expression()
                self.state = 651
                self.match(COLON)
                self.state = 652
                self.expression()
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def group(self) -> GroupContext:
        stream = self._input
        localctx = GroupContext(self._ctx, self.state)
        self.enterRule(localctx, 96, RULE_group)
        try:
            self.state = 676
            token = stream.types[stream.index]
            if token in [69]:
                self.state = 656
                self.match(LPAREN)
                self.state = 657
                self.expression()
                self.state = 658
                self.match(RPAREN)
            elif token in [71]:
                self.state = 660
                self.match(LBRACKET)
                self.state = 673
                _la = stream.types[stream.index]
                if (((_la) & ~0x3f) == 0 and ((1 << _la) & 144115188075856368) != 0) or ((((_la - 69)) & ~0x3f) == 0 and ((1 << (_la - 69)) & 6149) != 0):
                    self.state = 661
                    self.expression()
                    self.state = 671
                    token = stream.types[stream.index]
                    if token in [62]:
                        self.state = 662
                        self.match(RANGE_DOTS)
                        self.state = 663
                        self.expression()
                    elif token in [60, 72]:
                        self.state = 668
                        _la = stream.types[stream.index]
                        while _la==60:
                            self.state = 664
                            self.match(COMMA)
                            self.state = 665
                            self.expression()
                            self.state = 670
                            _la = stream.types[stream.index]
                    else:
                        raise NoViableAltException(self)
                self.state = 675
                self.match(RBRACKET)
            else:
                raise NoViableAltException(self)
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx


    def arguments(self) -> ArgumentsContext:
        stream = self._input
        localctx = ArgumentsContext(self._ctx, self.state)
        self.enterRule(localctx, 98, RULE_arguments)
        try:
            self.state = 678
            self.expression()
            self.state = 681
            _la = stream.types[stream.index]
            if _la==59:
                self.state = 679
                self.match(COLON)
                self.state = 680
                self.expression()
            self.state = 691
            _la = stream.types[stream.index]
            while _la==60:
                self.state = 683
                self.match(COMMA)
                self.state = 684
                self.expression()
                self.state = 687
                _la = stream.types[stream.index]
                if _la==59:
                    self.state = 685
                    self.match(COLON)
                    self.state = 686
                    self.expression()
                self.state = 693
                _la = stream.types[stream.index]
        except RecognitionException as re:
            self.recover(localctx, re)
        finally:
            self.exitRule()
        return localctx
