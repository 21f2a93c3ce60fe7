#error "The component 'discovery' is not selected: add `components: [+discovery]` to microros.yaml and generate again"
