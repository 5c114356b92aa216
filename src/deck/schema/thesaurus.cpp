// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/thesaurus.hpp"

#include <algorithm>
#include <cstddef>

#include "base/text.hpp"

namespace engrane::deck {

const std::vector<Concept>& concepts() {
  static const std::vector<Concept> all{
      // elements
      {{"ENGRANAJE", "ENGRENAJE", "RUEDA_DENTADA", "ROUE_DENTEE", "PIGNON", "PINON", "PINION", "COG", "COGWHEEL", "WHEEL", "WORM",
        "SINFIN", "TORNILLO_SINFIN", "VIS_SANS_FIN", "HYPOID", "HIPOIDE", "BEVEL", "SPUR"},
       {"GEAR"},
       {},
       {"gear", "tooth", "teeth", "worm"},
       {}},
      {{"CREMALLERA"}, {"RACK"}, {}, {"rack"}, {}},
      {{"REVOLUTE", "REVOLUTE_JOINT", "PIVOT", "PIN", "PIN_JOINT", "BISAGRA", "CHARNELA", "ARTICULACION", "ARTICULATION",
        "ROTOIDE", "GOZNE"},
       {"HINGE"},
       {},
       {"hinge", "revolute"},
       {}},
      {{"SAIL", "CLOTH", "FABRIC", "TELA", "VELA", "VOILE", "TOILE", "AIRBAG", "BALLOON"}, {"MEMBRANE"}, {}, {"membrane"}, {}},
      {{"ROPE", "WIRE", "CUERDA", "WINCH", "CABRESTANTE", "TREUIL"}, {"CABLE", "BAR"}, {}, {"cable"}, {}},
      {{"COJINETE", "RODAMIENTO", "BALL_BEARING", "ROLLER_BEARING", "JOURNAL", "CHUMACERA"},
       {"BEARING", "HINGE"},
       {},
       {"bearing"},
       "A rigid bearing is a HINGE, an elastic one a BEARING"},
      {{"ENGINE", "ACTUATOR", "ACTUADOR", "ACTIONNEUR", "VERIN", "SERVO", "ELECTROMOTOR"},
       {"MOTOR", "HINGE", "CONTROLLER"},
       {"DRIVE"},
       {"motor", "drive"},
       "A motor with a torque-speed curve is MOTOR, one whose motion is known DRIVE in a HINGE or PRISMATIC, one with feedback "
       "a CONTROLLER"},
      {{"BRAKE", "CLUTCH", "FRENO", "FREIN", "EMBRAGUE", "EMBRAYAGE"},
       {"HINGE", "TORQUE"},
       {"FRICTION"},
       {"brake", "clutch"},
       "A brake is FRICTION in a HINGE, or a TORQUE that follows a function"},
      {{"FREEWHEEL", "FREE_WHEEL", "ONE_WAY_CLUTCH", "OVERRUNNING_CLUTCH", "SPRAG_CLUTCH", "BACKSTOP", "RATCHET", "PAWL",
        "TRINQUETE", "RUEDA_LIBRE", "ROUE_LIBRE", "CLIQUET"},
       {"TSPRING", "HINGE"},
       {"CLAW"},
       {},
       "There is no card of a one-way clutch or ratchet: a TSPRING or HINGE with CLAW, a damping moment that is large for one "
       "direction of the speed and zero for the other, lets a shaft turn one way only, with a slow creep the other way"},
      {{"GOVERNOR", "CENTRIFUGAL_GOVERNOR", "FLYBALL", "SPEED_GOVERNOR", "REGULADOR_CENTRIFUGO"},
       {"CONTROLLER", "RIGID", "HINGE"},
       {},
       {},
       "A governor of balls on arms is built of RIGID, HINGE and PRISMATIC; one that only keeps a speed is a CONTROLLER"},
      {{"DIFFERENTIAL", "DIFERENCIAL", "DIFFERENTIEL", "PLANETARY", "PLANETARY_GEAR", "EPICYCLIC", "EPICYCLIC_GEAR", "PLANETARIO",
        "EPICICLOIDAL", "EPICYCLOIDAL"},
       {"GEAR", "HINGE"},
       {},
       {},
       "A differential or planetary gear is a GEAR for each pair of wheels that mesh, and for each planet a HINGE on the "
       "carrier, "
       "which is a body of its own"},
      {{"GYROSCOPE", "GYRO", "GIROSCOPO", "GIROSCOPIO", "SPINNING_TOP", "TROMPO", "TOUPIE"},
       {"RIGID", "INERTIA", "SPHERICAL", ".INI VIT"},
       {},
       {},
       "A gyroscope is a body, RIGID or INERTIA, on a SPHERICAL or on HINGEs; .INI VIT gives it its spin"},
      {{"GIMBAL", "GIMBALS", "SUSPENSION_CARDAN", "CARDAN_SUSPENSION"},
       {"HINGE", "UNIVERSAL", "SPHERICAL"},
       {},
       {},
       "A gimbal is HINGEs in a row, one for each ring; UNIVERSAL is two of them without a ring between"},
      {{"HUB", "MOYEU", "BUJE", "CUBO_DE_RUEDA"},
       {"WELD", "HINGE", "BEARING", "RIGID_LINK"},
       {},
       {},
       "A hub that is fast on its shaft is the shaft's node, or a WELD; one that turns on it a HINGE or BEARING; the bore of a "
       "meshed wheel a RIGID_LINK"},
      {{"TIRE", "TYRE", "NEUMATICO", "PNEU", "ROLLING_WHEEL", "ROAD_WHEEL"},
       {"RACK", "STOP", "BUSHING"},
       {},
       {},
       "Tyres are not in this version: a wheel that rolls without slip along a line is RACK with fine teeth, contact of a point "
       "with a plane is STOP with NORMAL, the elasticity of a tyre a BUSHING"},
      {{"HYDRAULIC", "HYDRAULICS", "HYDRAULIC_CYLINDER", "HYDRAULIC_ACTUATOR", "HIDRAULICO", "HIDRAULICA", "HYDRAULIQUE", "JACK",
        "GATO_HIDRAULICO", "PUMP", "BOMBA", "POMPE"},
       {"PRISMATIC", "CONTROLLER", "FORCE"},
       {"DRIVE"},
       {},
       "Hydraulics are not in this version: a cylinder is a PRISMATIC with DRIVE where its motion is known, with C where oil is "
       "throttled, or with a CONTROLLER that acts on it; a constant pressure is a FORCE"},
      {{"SHELL", "SHELLS", "PLATE", "PLATES", "COQUE", "PLAQUE", "PLACA", "LAMINA", "CASCARA"},
       {"MEMBRANE", ".HYP", "BEAM"},
       {},
       {},
       "Shells and plates, which bend, are not in this version: a skin that only stretches is MEMBRANE, a sheet loaded in its "
       "plane cells of .HYP MEMB BIDIM, a strip that bends BEAM, and a plate a mesh of solids of second order"},
      {{"PLASTICITY", "PLASTIC", "ELASTOPLASTIC", "YIELD", "YIELD_STRESS", "HARDENING", "CREEP", "VISCOELASTIC", "PLASTICIDAD",
        "PLASTICITE", "FLUENCIA", "FLUAGE"},
       {".MAT", "TSPRING", "SPRING"},
       {"LAW"},
       {},
       "Materials are elastic: plasticity, hardening and creep are not in this version. VON_MISES of .CHK tells whether cells "
       "would yield; springs take a curve by LAW"},
      {{"ROTATING_FRAME", "ROTATING_AXES", "CORIOLIS", "CENTRIFUGAL", "CENTRIFUGAL_FORCE", "CENTRIFUGAL_LOAD",
        "FUERZA_CENTRIFUGA", "FORCE_CENTRIFUGE", "REPERE_TOURNANT"},
       {".CLM ROT", ".SAM"},
       {},
       {"centrifugal"},
       "Motion is computed in axes at rest, where it needs no centrifugal or Coriolis forces. Statics of cells in axes that turn "
       "with them is .CLM ROT"},
      {{"TRANSLATIONAL", "TRANSLATION", "CORREDERA", "COULISSE", "COULISSEAU", "GUIDE", "GUIA"},
       {"PRISMATIC"},
       {},
       {"slide", "prismatic"},
       {}},
      {{"PISTON", "EMBOLO"},
       {"PRISMATIC", "GAS"},
       {},
       {"slide", "prismatic", "gas"},
       "The slide of a piston is PRISMATIC; the gas under it is GAS, in a box of MEMBRANE whose lid the slide carries"},
      {{"GAS_SPRING", "AIR_SPRING", "PNEUMATIC", "PNEUMATIC_SPRING", "MUELLE_DE_GAS", "RESSORT_A_GAZ", "COMPRESSED_AIR"},
       {"GAS", "SPRING"},
       {},
       {"gas"},
       "There is no card of a gas spring: it is GAS in a box of MEMBRANE with a lid on a PRISMATIC, or a SPRING with LAW"},
      {{"CILINDRICA", "CILINDRICO", "SLEEVE"}, {"CYLINDRICAL"}, {}, {"cylindrical"}, {}},
      {{"TORNILLO", "HUSILLO", "LEADSCREW", "BALLSCREW"}, {"SCREW"}, {}, {"screw"}, {}},
      {{"ROTULA", "ESFERICA", "BALL_JOINT", "SPHERE"}, {"SPHERICAL"}, {}, {"spherical"}, {}},
      {{"HOOKE", "U_JOINT", "JUNTA_CARDAN", "CARDANICA", "CROSS"}, {"UNIVERSAL"}, {}, {"universal"}, {}},
      {{"HOMOCINETICA", "CVJOINT", "RZEPPA"}, {"CONSTANT_VELOCITY"}, {}, {"constant velocity"}, {}},
      {{"SOLDADURA", "SOUDURE", "EMPOTRAMIENTO", "CLAMP", "GLUE", "RIGID_JOINT"}, {"WELD", ".CLM FIX"}, {}, {"weld"}, {}},
      {{"BIELA", "LINK", "BARRA", "TIRANTE", "STRUT", "ROD", "TRUSS"},
       {"DISTANCE", "BAR", "RIGID"},
       {},
       {"rod"},
       "A rigid rod is DISTANCE without mass and RIGID with mass, an elastic one BAR"},
      {{"BODY", "RIGID_BODY", "CUERPO", "CORPS", "SOLIDO", "SOLIDE", "PART", "PIEZA", "PIECE"}, {"RIGID"}, {}, {"rigid bod"}, {}},
      {{"MASS", "MASA", "POINT_MASS", "MASSE", "INERCIA", "FLYWHEEL", "VOLANTE", "VOLANT"},
       {"INERTIA", "RIGID"},
       {"M"},
       {"mass", "inertia"},
       {}},
      {{"MUELLE", "RESORTE", "STIFFENER"}, {"SPRING", "TSPRING"}, {}, {"spring"}, {}},
      {{"DAMPER", "DASHPOT", "SHOCK_ABSORBER", "AMORTIGUADOR", "AMORTISSEUR"},
       {"SPRING", "TSPRING"},
       {"C"},
       {"damp"},
       "A damper is a SPRING or TSPRING with C and without K"},
      {{"SHAFT", "AXLE", "ARBRE", "ARBOL", "TORSION", "TORSION_BAR", "RESORTE_TORSION"},
       {"TSPRING"},
       {},
       {"shaft", "torsion"},
       "The elasticity of a shaft is a TSPRING; a rigid shaft is one node, or RIGID"},
      {{"CASQUILLO", "SILENTBLOCK", "MOUNT", "RUBBER"}, {"BUSHING"}, {}, {"bush"}, {}},
      {{"TOPE", "CONTACT", "CONTACTO", "BUMPER", "IMPACT", "CHOC", "CHOQUE", "UNILATERAL"},
       {"STOP"},
       {},
       {"stop", "contact", "impact"},
       {}},
      {{"LEVA", "FOLLOWER"}, {"CAM"}, {}, {"cam"}, {}},
      {{"CORREA", "PULLEY", "POLEA", "POULIE", "CHAIN", "CADENA", "CHAINE", "CHAIN_DRIVE", "ROLLER_CHAIN", "SPROCKET",
        "BELT_DRIVE"},
       {"BELT"},
       {},
       {"belt", "pulley"},
       {}},
      {{"TIMING_BELT", "TOOTHED_BELT", "SYNCHRONOUS_BELT", "CORREA_DENTADA", "COURROIE_CRANTEE"},
       {"BELT"},
       {},
       {"belt"},
       "A toothed belt is BELT without STICK: it never slips; without K and EA the ratio is exact"},
      {{"TENSIONER", "BELT_TENSIONER", "TENSOR_DE_CORREA", "TENDEUR"},
       {"BELT", "PRISMATIC"},
       {},
       {"belt"},
       "BELT has two pulleys. A third one that presses on the belt is not in this version; a pulley on a PRISMATIC or HINGE "
       "with a spring tightens a BELT with K or EA"},
      {{"IDLER", "IDLER_PULLEY", "IDLER_GEAR", "GALET", "RUEDA_LOCA"},
       {"GEAR", "BELT"},
       {},
       {"gear", "belt"},
       "An idler between wheels is a node with two GEAR; one that a belt runs over is not in this version, BELT has two pulleys"},
      {{"MOMENT", "MOMENTO", "PAR"}, {"TORQUE", ".CLM CHA"}, {}, {"moment", "torque"}, {}},
      {{"FUERZA", "PRESCRIBED_FORCE", "APPLIED_FORCE", "EXTERNAL_FORCE", "POINT_LOAD", "NODAL_FORCE"},
       {"FORCE", ".CLM CHA"},
       {},
       {"force"},
       {}},
      {{"PROBE", "MEDIDA", "MESURE", "SONDE", "SENSOR_DE_POSICION"}, {"SENSOR"}, {}, {"sensor", "observes"}, {}},
      {{"PID", "CONTROL", "CONTROLADOR", "REGULADOR", "FEEDBACK"}, {"CONTROLLER"}, {}, {"control", "PID"}, {}},
      {{"ACOPLAMIENTO", "ACCOUPLEMENT", "RATIO_CONSTRAINT"}, {"COUPLING"}, {}, {"ratio"}, {}},
      // commands
      {{"SUPPORT", "APOYO", "APPUI", "GROUND", "TIERRA", "FIJAR", "FIJO", "BLOQUEAR", "BLOQUER"}, {".CLM FIX"}, {}, {"held"}, {}},
      {{"CARGA", "LOADS"}, {".CLM CHA", "FORCE", "TORQUE"}, {}, {"load", "forces"}, {}},
      {{"GRAVITY", "GRAVEDAD", "GRAVITE", "WEIGHT", "PESO", "POIDS", "PESANTEUR"},
       {".CLM STRU"},
       {},
       {"gravity"},
       "Gravity is .CLM STRU ACC VAL 0 0 -9.81"},
      {{"FUNCION", "CURVE", "CURVA", "COURBE"}, {".FCT"}, {}, {"function"}, {}},
      {{"NODO", "NODOS", "NODE", "NUDO", "NOEUD", "PUNTO", "POINT", "COORDINATES"}, {".NOE"}, {"N", "NOEUD"}, {"node"}, {}},
      {{"ELEMENT", "ELEMENTS", "ELEMENTO", "ELEMENTOS", "MECANISMO", "MECANISME"}, {".MCE"}, {}, {"element"}, {}},
      {{"GROUP", "GRUPO", "GROUPE", "SET"}, {".SEL"}, {"GROUP"}, {"group"}, {}},
      {{"TIMESTEP", "TIME_STEP", "PASO", "PAS", "STEP"}, {".SUB"}, {"H"}, {"step"}, {}},
      {{"ANALISIS", "INTEGRATOR", "INTEGRADOR", "SOLVER", "DYNAMICS", "DINAMICA", "DYNAMIQUE", "STATICS"},
       {".SAM"},
       {},
       {"integration", "analysis"},
       {}},
      {{"OUTPUT", "SALIDA", "SORTIE", "RESULTS", "RESULTADOS", "RESULTATS", "HISTORY"}, {".SAI"}, {}, {"archive", "histor"}, {}},
      {{"COMPROBACION", "ASSERT", "EXPECT"}, {".CHK"}, {}, {"check"}, {}},
      {{"UNIDADES", "UNITES", "UNITS"}, {".UNIT"}, {}, {"unit"}, {}},
      {{"INITIAL", "INICIAL", "INITIAL_VELOCITY", "VELOCIDAD_INICIAL"}, {".INI VIT", ".INI DEP"}, {}, {"initial"}, {}},
      // keywords and topics
      {{"FRICTION", "FRICCION", "ROZAMIENTO", "FROTTEMENT", "FROTTEMENTS", "COULOMB", "MU", "ADHERENCE"},
       {},
       {"FRICTION"},
       {"friction", "coulomb"},
       {}},
      {{"BACKLASH", "JUEGO", "HOLGURA", "CLEARANCE", "PLAY", "JEU"}, {}, {"JEU"}, {"backlash", "play", "clearance"}, {}},
      {{"STIFFNESS", "RIGIDEZ", "RAIDEUR", "RIGIDITE"}, {}, {"K", "KM", "KT"}, {"stiffness"}, {}},
      {{"DAMPING", "AMORTIGUAMIENTO", "AMORTISSEMENT"}, {}, {"C", "DAMP"}, {"damping"}, {}},
      {{"TEETH", "DIENTES", "DENTS", "DIENTE", "DENT"}, {}, {"Z"}, {"tooth", "teeth"}, {}},
      {{"MODULE", "MODULO", "NORMAL_MODULE"}, {}, {"MN"}, {"module"}, {}},
      {{"ALFA", "PRESSURE_ANGLE", "ANGULO_DE_PRESION", "ANGLE_DE_PRESSION"}, {}, {"ALPHA"}, {"pressure angle"}, {}},
      {{"BETA", "HELIX_ANGLE", "HELICE"}, {}, {"HELIX"}, {"helix"}, {}},
      {{"EJE", "AXE", "DIRECTION"}, {}, {"AXIS"}, {"axis"}, {}},
      {{"SPEED", "VELOCIDAD", "VITESSE", "VELOCITY"}, {}, {"DRIVE"}, {"speed", "velocit"}, {}},
      {{"TRANSMISSION_ERROR", "ERROR_DE_TRANSMISION"}, {}, {"ERR"}, {"transmission error"}, {}},
      {{"EIGENVALUE",    "EIGENMODE",   "EIGENFREQUENCY",    "EIGEN",
        "MODAL",         "MODES",       "MODE_SHAPE",        "MODAL_ANALYSIS",
        "FREQUENCY",     "FREQUENCIES", "NATURAL_FREQUENCY", "NATURAL_FREQUENCIES",
        "RESONANCE",     "VIBRATION",   "VIBRATION_MODE",    "DYNAM",
        "VALEUR_PROPRE", "MODE_PROPRE", "FRECUENCIA_PROPIA", "AUTOVALOR",
        "FRECUENCIA",    "FREQUENCE",   "VIBRACION"},
       {".SAM", ".BUCKLING"},
       {},
       {"buckling"},
       "Modes and frequencies of vibration are not in this version: a frequency is a line of `engrane spectrum` of a DYNAMIC "
       "run that starts from a pull or a blow. Eigenvalues are computed for .BUCKLING only"},
      {{"RESTART", "REPRISE", "REINICIO", "CONTINUE"}, {".SAM"}, {"RESTART"}, {"restart"}, {}},
  };
  return all;
}

std::string plain_word(std::string_view word) {
  // the letters of Latin-1 from À on, without diacritics
  static constexpr std::string_view letters = "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
  std::string plain;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto byte = static_cast<unsigned char>(word[i]);
    if (byte == 0xC3 && i + 1 < word.size()) {
      const auto next = static_cast<std::size_t>(static_cast<unsigned char>(word[i + 1]) & 0x3F);
      plain += letters[next];
      ++i;
    } else {
      plain += word[i] == '-' || word[i] == ' ' ? '_' : word[i];
    }
  }
  return upper(plain);
}

std::vector<const Concept*> find_concepts(std::string_view word) {
  std::string plain = plain_word(word);
  const auto having = [](const std::string& wanted) {
    std::vector<const Concept*> found;
    for (const Concept& c : concepts())
      if (std::find(c.words.begin(), c.words.end(), wanted) != c.words.end()) found.push_back(&c);
    return found;
  };
  auto found = having(plain);
  if (found.empty() && plain.size() > 3 && plain.back() == 'S') found = having(plain.substr(0, plain.size() - 1));
  return found;
}

}  // namespace engrane::deck
